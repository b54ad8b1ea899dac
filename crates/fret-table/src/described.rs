//! What a closed form says of itself, from its doc comments: `#[derive(Numbers)]` of its public fields, `#[functions]` of its methods.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::{
    Attribute, Data, DeriveInput, Error, Expr, ExprLit, Fields, FnArg, ImplItem, ItemImpl, Lit, Meta, Pat,
    Result, Visibility,
};

/// The public fields of a struct, with their doc comments.
pub fn numbers(input: &DeriveInput) -> Result<TokenStream> {
    let (name, title, meaning) = (&input.ident, input.ident.to_string(), doc(&input.attrs));
    let Data::Struct(syn::DataStruct { fields: Fields::Named(fields), .. }) = &input.data else {
        return Err(Error::new_spanned(name, "the numbers of a solution have names"));
    };
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    for field in fields.named.iter().filter(|field| matches!(field.vis, Visibility::Public(_))) {
        let Some(ident) = &field.ident else { continue };
        let (ty, key, meaning) = (&field.ty, ident.to_string(), doc(&field.attrs));
        let kind = quote!(#ty).to_string();
        entries.push(quote!(crate::analytic::form::Entry { name: #key, kind: #kind, meaning: #meaning }));
        values.push(quote!((#key.to_owned(), serde_json::json!(self.#ident))));
    }
    Ok(quote! {
        impl crate::analytic::form::Numbers for #name {
            const TITLE: &'static str = #title;
            const MEANING: &'static str = #meaning;
            const ENTRIES: &'static [crate::analytic::form::Entry] = &[#(#entries),*];

            fn numbers(&self) -> serde_json::Map<String, serde_json::Value> {
                [#(#values),*].into_iter().collect()
            }
        }
    })
}

/// The methods of an `impl` that are marked `#[shown]`, with their doc comments and the names of their coordinates.
pub fn functions(mut implementation: ItemImpl) -> Result<TokenStream> {
    let (mut entries, mut arms) = (Vec::new(), Vec::new());
    for item in &mut implementation.items {
        let ImplItem::Fn(function) = item else { continue };
        let Some(mark) = function.attrs.iter().position(|attribute| attribute.path().is_ident("shown"))
        else {
            continue;
        };
        function.attrs.remove(mark);
        let mut at = Vec::new();
        for input in &function.sig.inputs {
            let FnArg::Typed(input) = input else { continue };
            let Pat::Ident(coordinate) = &*input.pat else {
                return Err(Error::new_spanned(input, "a coordinate is a name"));
            };
            at.push(&coordinate.ident);
        }
        let (ident, place) = (&function.sig.ident, Literal::usize_unsuffixed(entries.len()));
        let (key, meaning) = (ident.to_string(), doc(&function.attrs));
        let names = at.iter().map(ToString::to_string);
        arms.push(quote!((#place, &[#(#at),*]) => self.#ident(#(#at),*)));
        entries.push(
            quote!(crate::analytic::form::Function { name: #key, at: &[#(#names),*], meaning: #meaning }),
        );
    }
    let name = &implementation.self_ty;
    Ok(quote! {
        #implementation

        impl crate::analytic::form::Functions for #name {
            const FUNCTIONS: &'static [crate::analytic::form::Function] = &[#(#entries),*];

            fn value(&self, function: usize, at: &[f64]) -> f64 {
                match (function, at) {
                    #(#arms,)*
                    _ => f64::NAN,
                }
            }
        }
    })
}

/// A doc comment, line by line.
fn doc(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(entry) if entry.path.is_ident("doc") => match &entry.value {
            Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) => Some(text.value().trim().to_owned()),
            _ => None,
        },
        _ => None,
    });
    lines.collect::<Vec<_>>().join("\n")
}
