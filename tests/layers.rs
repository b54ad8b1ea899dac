//! Imports point down: modules of the library import modules of lower layers alone, as the table of `ARCHITECTURE.md` says, and no files
//! of any crate import each other in a circle. The table is read from the page, so that page and code cannot drift apart.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};
use syn::{Attribute, Item, UseTree};

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the repository")
}

/// Layer of every module by the table: lines `layer N   name/   what it is`, and those below that go on with the layer.
fn layers() -> BTreeMap<String, usize> {
    let page = fs::read_to_string(repository().join("ARCHITECTURE.md")).unwrap();
    let table = page.split("```").find(|block| block.contains("layer 1 ")).expect("a table of layers");
    let mut layers = BTreeMap::new();
    let mut layer = 0;
    for line in table.lines().filter(|line| !line.trim().is_empty()) {
        let mut words = line.split_whitespace().peekable();
        if words.next_if_eq(&"layer").is_some() {
            layer = words.next().and_then(|word| word.parse().ok()).expect("the number of a layer");
        }
        let name = words.next().expect("a module").trim_end_matches('/').to_owned();
        assert!(layers.insert(name.clone(), layer).is_none(), "{name} stands on two layers");
    }
    layers
}

/// A source file: its module, and all that it names.
struct Source {
    /// Path below `src`.
    file: String,
    /// Names that it hands on: by which name, from where.
    exports: BTreeMap<String, Vec<String>>,
    /// Absolute paths that it uses, without `crate`.
    uses: BTreeSet<Vec<String>>,
}

/// The files of a crate by module; modules of tests left out.
struct Sources(BTreeMap<Vec<String>, Source>);

impl Sources {
    fn of(folder: &Path) -> Self {
        let mut sources = Self(BTreeMap::new());
        let root = ["lib.rs", "main.rs"].map(|name| folder.join(name)).into_iter().find(|root| root.exists());
        sources.read(folder, Vec::new(), &root.expect("a crate begins with lib.rs or main.rs"));
        sources
    }

    fn read(&mut self, root: &Path, module: Vec<String>, path: &Path) {
        let text = fs::read_to_string(path).unwrap();
        let syntax = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let children: Vec<String> = syntax
            .items
            .iter()
            .filter_map(child)
            .map(|name| name.trim_start_matches("r#").to_owned())
            .collect();
        for name in &children {
            let inside: PathBuf = module.iter().fold(root.to_owned(), |path, part| path.join(part));
            let [flat, folder] = [inside.join(format!("{name}.rs")), inside.join(name).join("mod.rs")];
            let path = if flat.exists() { flat } else { folder };
            self.read(root, [&module[..], std::slice::from_ref(name)].concat(), &path);
        }
        let mut reader = Reader {
            module: module.clone(),
            children: &children,
            exports: BTreeMap::new(),
            uses: BTreeSet::new(),
        };
        reader.visit_file(&syntax);
        let Reader { exports, uses, .. } = reader;
        let file = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
        self.0.insert(module, Source { file, exports, uses });
    }

    /// The module in which a path ends, through all that is handed on.
    fn home(&self, path: &[String]) -> Vec<String> {
        let mut module = Vec::new();
        for (depth, name) in path.iter().enumerate() {
            module.push(name.clone());
            if self.0.contains_key(&module) {
                continue;
            }
            module.pop();
            if let Some(from) = self.0.get(&module).and_then(|source| source.exports.get(name)) {
                return self.home(&[from, &path[depth + 1..]].concat());
            }
            break;
        }
        module
    }

    /// Which module imports which.
    fn imports(&self) -> BTreeMap<&Vec<String>, BTreeSet<Vec<String>>> {
        let homes = |module: &Vec<String>, source: &Source| {
            source.uses.iter().map(|path| self.home(path)).filter(|home| home != module).collect()
        };
        self.0.iter().map(|(module, source)| (module, homes(module, source))).collect()
    }
}

/// The module in another file that an item declares, unless it is one of tests.
fn child(item: &Item) -> Option<String> {
    match item {
        Item::Mod(module) if module.content.is_none() && !of_tests(&module.attrs) => {
            Some(module.ident.to_string())
        }
        _ => None,
    }
}

fn of_tests(attributes: &[Attribute]) -> bool {
    let is_test = |attribute: &Attribute| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    };
    attributes.iter().any(is_test)
}

/// Collects the paths of a file.
struct Reader<'a> {
    /// The module that is read: that of the file, or one inside it.
    module: Vec<String>,
    /// Modules of the file that have files of their own.
    children: &'a [String],
    exports: BTreeMap<String, Vec<String>>,
    uses: BTreeSet<Vec<String>>,
}

impl Reader<'_> {
    /// The path without `crate`; `None` for what comes from elsewhere.
    fn absolute(&self, path: &[String]) -> Option<Vec<String>> {
        let first = path.first()?;
        let above = path.iter().take_while(|part| *part == "super").count();
        match first.as_str() {
            "crate" => Some(path[1..].to_vec()),
            "self" => Some([&self.module, &path[1..]].concat()),
            "super" => {
                let base = &self.module[..self.module.len().checked_sub(above)?];
                Some([base, &path[above..]].concat())
            }
            name if self.children.iter().any(|child| child == name) => Some([&self.module, path].concat()),
            _ => None,
        }
    }

    fn import(&mut self, tree: &UseTree, before: &[String], public: bool) {
        let and = |name: String| [before, &[name]].concat();
        match tree {
            UseTree::Path(path) => self.import(&path.tree, &and(path.ident.to_string()), public),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.import(tree, before, public)),
            UseTree::Glob(_) => self.leaf(before, None),
            UseTree::Name(name) if name.ident == "self" => self.leaf(before, None),
            UseTree::Name(name) => {
                let name = name.ident.to_string();
                self.leaf(&and(name.clone()), public.then_some(name));
            }
            UseTree::Rename(rename) => {
                self.leaf(&and(rename.ident.to_string()), public.then(|| rename.rename.to_string()));
            }
        }
    }

    fn leaf(&mut self, path: &[String], handed_on_as: Option<String>) {
        if let Some(path) = self.absolute(path) {
            if let Some(name) = handed_on_as {
                self.exports.insert(name, path.clone());
            }
            self.uses.insert(path);
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        let attributes = match item {
            Item::Mod(item) => &item.attrs,
            Item::Fn(item) => &item.attrs,
            Item::Impl(item) => &item.attrs,
            Item::Use(item) => &item.attrs,
            _ => &Vec::new(),
        };
        if !of_tests(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.module.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.module.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let public = !matches!(item.vis, syn::Visibility::Inherited);
        self.import(&item.tree, &[], public);
    }

    /// Who may see an item is no import.
    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if names.len() > 1 {
            self.leaf(&names, None);
        }
        visit::visit_path(self, path);
    }
}

/// Groups of modules each of which reaches all others of its group.
fn circles<'a>(imports: &BTreeMap<&'a Vec<String>, BTreeSet<Vec<String>>>) -> Vec<Vec<&'a Vec<String>>> {
    let reached = |from: &Vec<String>| {
        let mut seen = BTreeSet::new();
        let mut open: Vec<&Vec<String>> = vec![from];
        while let Some(next) = open.pop() {
            for to in imports.get(next).into_iter().flatten() {
                if seen.insert(to) {
                    open.push(to);
                }
            }
        }
        seen
    };
    let all: BTreeMap<&'a Vec<String>, BTreeSet<&Vec<String>>> =
        imports.keys().map(|&module| (module, reached(module))).collect();
    let mut groups: Vec<Vec<&'a Vec<String>>> = Vec::new();
    for (&module, reached) in &all {
        if !reached.contains(module) {
            continue;
        }
        let mutual = |other: &&'a Vec<String>| reached.contains(*other) && all[*other].contains(module);
        match groups.iter_mut().find(|group| mutual(&group[0])) {
            Some(group) => group.push(module),
            None => groups.push(vec![module]),
        }
    }
    groups
}

#[test]
fn modules_import_lower_layers_alone() {
    let layers = layers();
    let sources = Sources::of(&repository().join("crates/fret-core/src"));
    let modules: BTreeSet<&String> = sources.0.keys().filter_map(|module| module.first()).collect();
    assert_eq!(modules, layers.keys().collect(), "modules of the library, and those of the table");
    let mut found = BTreeMap::new();
    for (module, imports) in sources.imports() {
        let Some(from) = module.first() else { continue };
        for to in imports.iter().filter_map(|path| path.first()).filter(|to| *to != from) {
            if layers[to] >= layers[from] {
                let arrow = format!("{from} -> {to}");
                found.entry(arrow).or_insert_with(Vec::new).push(sources.0[module].file.as_str());
            }
        }
    }
    assert!(found.is_empty(), "imports that do not point down, by file: {found:#?}");
}

/// A folder or a file beside `lib.rs`, with all that is in it.
fn rooms(
    imports: &BTreeMap<&Vec<String>, BTreeSet<Vec<String>>>,
) -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
    let room = |module: &Vec<String>| module.iter().take(1).cloned().collect::<Vec<_>>();
    let mut rooms = BTreeMap::new();
    for (module, to) in imports.iter().filter(|(module, _)| !module.is_empty()) {
        let own = room(module);
        let others = to.iter().map(room).filter(|other| *other != own && !other.is_empty());
        rooms.entry(own.clone()).or_insert_with(BTreeSet::new).extend(others.collect::<Vec<_>>());
    }
    rooms
}

#[test]
fn no_rooms_of_the_command_import_each_other_in_a_circle() {
    let rooms = rooms(&Sources::of(&repository().join("crates/fret-cli/src")).imports());
    let imports = rooms.iter().map(|(room, to)| (room, to.clone())).collect();
    let found = circles(&imports);
    assert!(found.is_empty(), "rooms that import each other: {found:?}");
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(repository().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let sources = Sources::of(&folder.join("src"));
        let imports = sources.imports();
        for group in circles(&imports) {
            let files = group.iter().map(|module| folder.join("src").join(&sources.0[*module].file));
            found.insert(files.collect::<Vec<_>>());
        }
    }
    assert!(found.is_empty(), "files that import each other: {found:#?}");
}

/// Transforms, pictures and the reader of tables know no mechanics, and need nothing of this project.
#[test]
fn crates_without_mechanics_need_none_of_ours() {
    for name in ["fret-drawing", "fret-fft", "fret-table"] {
        let manifest = fs::read_to_string(repository().join("crates").join(name).join("Cargo.toml")).unwrap();
        let dependencies =
            manifest.split("\n[").find_map(|table| table.strip_prefix("dependencies]\n")).unwrap();
        let ours: Vec<&str> = dependencies.lines().filter(|line| line.starts_with("fret")).collect();
        assert!(ours.is_empty(), "{name} needs {ours:?}");
    }
}

#[test]
fn every_way_to_name_another_file_is_read() {
    let text = "use super::one::{Two, three::Four}; pub(crate) use child::Five as Six; #[cfg(test)] use crate::not_me::A;
        fn f() { crate::seven::g() } mod inner { use super::super::eight; } #[cfg(test)] mod tests { use super::nor_me; }";
    let children = ["child".to_owned()];
    let module = ["top", "here"].map(str::to_owned).to_vec();
    let mut reader = Reader { module, children: &children, exports: BTreeMap::new(), uses: BTreeSet::new() };
    reader.visit_file(&syn::parse_file(text).unwrap());
    let found: Vec<String> = reader.uses.iter().map(|path| path.join("::")).collect();
    let wanted =
        ["seven::g", "top::eight", "top::here::child::Five", "top::one::Two", "top::one::three::Four"];
    assert_eq!(found, wanted);
    assert_eq!(reader.exports["Six"].join("::"), "top::here::child::Five");
}

#[test]
fn a_circle_is_found() {
    let name = |name: &str| vec![name.to_owned()];
    let [a, b, c, d] = ["a", "b", "c", "d"].map(name);
    let imports = BTreeMap::from([
        (&a, BTreeSet::from([b.clone()])),
        (&b, BTreeSet::from([c.clone(), d.clone()])),
        (&c, BTreeSet::from([a.clone()])),
        (&d, BTreeSet::new()),
    ]);
    assert_eq!(circles(&imports), [[&a, &b, &c]]);
}

/// Pages for developers name source files; each of them exists. A name without folders may stand anywhere.
#[test]
fn files_that_the_pages_name_exist() {
    let sources: Vec<String> = ["crates", "tests"]
        .iter()
        .flat_map(|folder| walkdir::WalkDir::new(repository().join(folder)))
        .filter_map(Result::ok)
        .map(|entry| format!("/{}", entry.path().strip_prefix(repository()).unwrap().to_string_lossy()))
        .map(|path| path.replace('\\', "/"))
        .filter(|path| is_source(path))
        .collect();
    let missing: Vec<String> = ["ARCHITECTURE.md", "CONTRIBUTING.md", "docs/developers/extend.md"]
        .iter()
        .flat_map(|page| {
            let text = fs::read_to_string(repository().join(page)).unwrap();
            let named = text.split('`').skip(1).step_by(2).filter(|word| is_source(word));
            let exists = |name: &str| {
                let (start, end) = name.split_once('*').unwrap_or((name, ""));
                sources.iter().any(|path| {
                    path.rsplit_once(&format!("/{start}")).is_some_and(|(_, rest)| rest.ends_with(end))
                })
            };
            let unknown = named.filter(|name| !exists(name));
            unknown.map(|name| format!("{page}: {name}")).collect::<Vec<_>>()
        })
        .collect();
    assert!(missing.is_empty(), "{missing:#?}");
}

fn is_source(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension == "rs")
}
