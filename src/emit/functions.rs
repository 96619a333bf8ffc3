//! The library and node declarations that a module needs, each once, under names that do not clash.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::Reached;
use super::names::Names;
use super::text::Text;
use crate::node::{Catalog, Item, reachable, rename};
use crate::program::{Op, Program, Resource};

/// Declarations in the order of writing.
#[derive(Default)]
pub(crate) struct Functions {
    /// Text, and the node that it belongs to.
    structs: Vec<(String, Option<usize>)>,
    others: Vec<(String, Option<usize>)>,
    /// The WGSL name of each function in use.
    pub(crate) names: BTreeMap<usize, String>,
    /// The WGSL name of the structure that each of them returns, if it returns one.
    pub(crate) results: BTreeMap<usize, String>,
}

impl Functions {
    fn push(&mut self, text: String, node: Option<usize>) {
        if text.starts_with("struct") { self.structs.push((text, node)) } else { self.others.push((text, node)) }
    }

    pub(crate) fn write_structs(&self, text: &mut Text) {
        for (item, _) in &self.structs {
            text.blank();
            text.line(item);
        }
    }

    pub(crate) fn write_functions(&self, text: &mut Text, program: &Program) {
        let mut last_was_const = false;
        for (item, node) in &self.others {
            let is_const = item.starts_with("const") && !item.contains('\n');
            if !(last_was_const && is_const) {
                text.blank();
            }
            last_was_const = is_const;
            let start = text.len();
            text.line(item);
            if let Some(node) = node {
                text.origin(start, &program.nodes[*node].id, None);
            }
        }
    }
}

/// Everything that the reached functions mention, directly or through others.
pub(crate) fn gather(program: &Program, reached: &Reached, catalog: &Catalog, names: &mut Names) -> Functions {
    let mut functions = Functions::default();
    let variants: Vec<Item> = variants(program, reached).into_iter().flat_map(|v| catalog.variant(v)).collect();
    let mut library: BTreeMap<&str, &Item> = BTreeMap::new();
    let mut roots: BTreeSet<&str> = BTreeSet::new();
    let mut order: Vec<&str> = Vec::new();
    let first_user = first_users(program, reached);
    let mut own: Vec<(usize, Vec<&Item>)> = Vec::new();
    for &index in &reached.functions {
        let instance = &program.functions[index];
        for file in catalog.libraries_of(&instance.definition) {
            for item in &file.items {
                if library.insert(&item.name, item).is_none() {
                    order.push(&item.name);
                }
            }
        }
        let items: Vec<&Item> = instance.definition.items.iter().filter(|i| i.name != "T").collect();
        let function = instance.function();
        let inline = instance.definition.header.inline && function.body.is_some();
        let kept: BTreeSet<&str> = if inline {
            let item = items.iter().find(|i| i.name == function.name);
            let mentioned: Vec<&str> =
                item.map(|i| i.mentions.iter().map(String::as_str).collect()).unwrap_or_default();
            roots.extend(&mentioned);
            reachable(&items, &mentioned).into_iter().filter(|n| *n != function.name).collect()
        } else {
            reachable(&items, &[function.name.as_str()])
        };
        let kept: Vec<&Item> = items.into_iter().filter(|i| kept.contains(i.name.as_str())).collect();
        for item in &kept {
            roots.extend(item.mentions.iter().map(String::as_str));
        }
        own.push((index, kept));
    }
    for item in &variants {
        if library.insert(&item.name, item).is_none() {
            order.push(&item.name);
        }
    }
    // The space of a light is a structure even where no node mentions it by name.
    for resource in &reached.resources {
        if let Resource::Space(light) = resource {
            let definition = &program.nodes[*light].definition;
            roots.insert("LightSpace");
            if let Some(space) = &definition.header.space {
                roots.extend(space.selector(definition));
                roots.extend(space.blends(definition).then_some("split_blend"));
            }
        }
    }
    let items: Vec<&Item> = order.iter().filter_map(|n| library.get(n).copied()).collect();
    let roots: Vec<&str> = roots.into_iter().filter(|r| library.contains_key(r)).collect();
    let kept = reachable(&items, &roots);
    for item in items.iter().filter(|i| kept.contains(i.name.as_str())) {
        names.claim(&item.name);
        functions.push(item.text.clone(), None);
    }
    // Instances of one file share every declaration that is the same text all the way down; others get their own name.
    let mut written: BTreeMap<String, String> = BTreeMap::new();
    for (index, kept) in own {
        let instance = &program.functions[index];
        let shape = instance.generic.as_ref().map(crate::semantic::Shape::wgsl);
        let mut renamed: BTreeMap<&str, String> = BTreeMap::new();
        let mut fresh: Vec<&Item> = Vec::new();
        for item in &kept {
            let closure = reachable(&kept, &[item.name.as_str()]);
            let parts: Vec<&&Item> = kept.iter().filter(|i| closure.contains(i.name.as_str())).collect();
            let mut key = format!("{}\n{}", instance.definition.header.source.name, item.name);
            for part in &parts {
                key.push('\n');
                key.push_str(&instantiate(part, &BTreeMap::new(), shape.as_deref()));
            }
            let name = match written.get(&key) {
                Some(name) => name.clone(),
                None => {
                    let generic = parts.iter().any(|p| p.mentions.iter().any(|m| m == "T"));
                    let wanted = match &shape {
                        Some(shape) if generic => format!("{}_{shape}", item.name),
                        _ => item.name.clone(),
                    };
                    let name = if names.claim(&wanted) { wanted } else { names.fresh(&wanted) };
                    written.insert(key, name.clone());
                    fresh.push(item);
                    name
                }
            };
            renamed.insert(&item.name, name);
        }
        for item in fresh {
            let text = instantiate(item, &renamed, shape.as_deref());
            functions.push(text.into_owned(), first_user.get(&index).copied());
        }
        let name = renamed.get(instance.function().name.as_str()).cloned().unwrap_or_default();
        functions.names.insert(index, name);
        let result = instance.function().result_struct.as_deref().and_then(|s| renamed.get(s));
        functions.results.extend(result.map(|s| (index, s.clone())));
    }
    functions
}

/// The libraries that lights want instead of the usual functions, each once.
fn variants(program: &Program, reached: &Reached) -> BTreeSet<&'static str> {
    let of = |resource: &Resource| match resource {
        Resource::Space(light) => {
            let definition = &program.nodes[*light].definition;
            definition.header.space.as_ref()?.variant(definition)
        }
        _ => None,
    };
    reached.resources.iter().filter_map(of).collect()
}

/// The text of a declaration with `T` and the names of other declarations replaced.
fn instantiate<'a>(item: &'a Item, renamed: &BTreeMap<&str, String>, shape: Option<&str>) -> Cow<'a, str> {
    let other = |word: &String| match (word.as_str(), shape) {
        ("T", Some(_)) => true,
        (word, _) => renamed.get(word).is_some_and(|new| new != word),
    };
    if !item.mentions.iter().any(other) {
        return Cow::Borrowed(&item.text);
    }
    Cow::Owned(rename(&item.text, &|word| match (word, shape) {
        ("T", Some(shape)) => Some(shape.to_owned()),
        _ => renamed.get(word).cloned(),
    }))
}

/// For each function the first node that calls it.
fn first_users(program: &Program, reached: &Reached) -> BTreeMap<usize, usize> {
    let mut users = BTreeMap::new();
    for id in &reached.order {
        let expression = program.get(*id);
        if let Op::Call(function) | Op::Template { function: Some(function), .. } = expression.op
            && let Some(node) = expression.origins.first()
        {
            users.entry(function).or_insert(node);
        }
    }
    users
}
