// What the search of the site finds: node search.js LUNR INDEX QUERY... prints the page of the best hit of each query.
// Ranked like Material for MkDocs: titles count a thousand times, all words must occur, the last may be unfinished.
const fs = require("fs");
const lunr = require(fs.realpathSync(process.argv[2]));
const { docs } = JSON.parse(fs.readFileSync(process.argv[3], "utf8"));

const index = lunr(function () {
  this.ref("location");
  this.field("title", { boost: 1000 });
  this.field("text");
  for (const doc of docs) this.add({ ...doc, text: doc.text.replace(/<[^>]*>/g, " ") }, { boost: doc.boost || 1 });
});

const pages = (hits) => [...new Set(hits.map((hit) => hit.ref.split("#")[0]))];
const answer = {};
for (const query of process.argv.slice(4)) {
  const words = query.toLowerCase().split(/\s+/);
  const all = words.map((word) => `+${word}`).join(" ");
  let hits = index.search(all);
  if (!hits.length) hits = index.search(query);
  answer[query] = pages(hits).slice(0, 5);
}
console.log(JSON.stringify(answer));
