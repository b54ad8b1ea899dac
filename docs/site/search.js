// What the search of the built site finds: node search.js SITE QUERY... prints the pages of the best hits of each query.
// The site's own search worker answers, the one that the browser runs, with the queries it would get letter by letter.
const fs = require("fs");
const path = require("path");
const vm = require("vm");

const site = process.argv[2];
const workers = path.join(site, "assets", "javascripts", "workers");
const worker = fs.readdirSync(workers).find((name) => /^search\..*\.js$/.test(name));
let answer;
let hears;
const room = {
  console,
  postMessage: (message) => answer(message),
  addEventListener: (_, listener) => (hears = listener),
  importScripts: () => {},
  location: { href: "http://site/", pathname: "/" },
};
room.self = room;
vm.runInNewContext(fs.readFileSync(path.join(workers, worker), "utf8"), room);

const asked = (type, data) =>
  new Promise((resolve) => {
    answer = resolve;
    hears({ data: { type, data } });
  });

(async () => {
  const index = JSON.parse(fs.readFileSync(path.join(site, "search", "search_index.json"), "utf8"));
  await asked(0, { ...index, options: { suggest: false } });
  const found = {};
  for (const query of process.argv.slice(3)) {
    const { data } = await asked(2, query);
    const hits = data.items.flat().map((hit) => hit.location.split("#")[0]);
    found[query] = [...new Set(hits)].slice(0, 5);
  }
  console.log(JSON.stringify(found));
})();
