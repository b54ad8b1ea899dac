//! `#[derive(Table)]`: a table of a case file, written once.
//!
//! - A struct is a table: each field a key, left out where its type is `Option`. `#[range(RANGE)]`, any constant of type
//!   `crate::document::Range`, says what its numbers may be. `#[table(flatten)]` takes the keys of another table in. Doc comments become
//!   the schema by `#[derive(JsonSchema)]` beside it.
//! - An enum of bare variants is a word, by the names that serde or schemars give its variants, else in `snake_case`.
//! - An enum whose variants hold one value each is a choice between kinds of values; `#[expected("...")]` says which, in words.
//!
//! ```ignore
//! #[derive(Table, JsonSchema)]
//! #[schemars(deny_unknown_fields)]
//! struct Steady {
//!     /// Differences from cycle to cycle, relative.
//!     #[range(Range::up_to(1.0, "must lie above 0, and at 1 at the most"))]
//!     pub tolerance: f64,
//!     /// Maximum number of cycles.
//!     pub most_cycles: Option<usize>,
//! }
//! ```
//!
//! becomes
//!
//! ```ignore
//! impl Keys for Steady {
//!     fn keys() -> Vec<&'static str> { vec!["tolerance", "most_cycles"] }
//!     fn read_keys(table: &TableReader<'_, '_>, reader: &mut Reader) -> Option<Self> {
//!         let tolerance = table.required("tolerance", Some(Range::up_to(...)), reader);
//!         let most_cycles = table.optional("most_cycles", None, reader);
//!         Some(Self { tolerance: tolerance?, most_cycles })
//!     }
//! }
//! ```
//!
//! and what implements `Keys` can be read as a table.
//!
//! Beside it, for closed forms: `#[derive(Numbers)]` and `#[functions]`, by which a solution says what it holds in the words of its doc comments.

mod described;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Attribute, Data, DeriveInput, Error, Expr, Field, Fields, Ident, LitStr, Result, Type, Variant};

/// See the crate.
#[proc_macro_derive(Table, attributes(range, table, expected))]
pub fn table(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse_macro_input!(input as DeriveInput);
    let implementation = match &input.data {
        Data::Struct(data) => of_struct(&input.ident, &data.fields),
        Data::Enum(data) if data.variants.iter().all(|variant| variant.fields.is_empty()) => {
            of_words(&input.ident, &data.variants.iter().collect::<Vec<_>>())
        }
        Data::Enum(data) => of_choice(&input.ident, &input.attrs, &data.variants.iter().collect::<Vec<_>>()),
        Data::Union(_) => Err(Error::new_spanned(&input.ident, "a table is a struct or an enum")),
    };
    implementation.unwrap_or_else(Error::into_compile_error).into()
}

/// The public fields of a closed form's solution, with their doc comments.
#[proc_macro_derive(Numbers)]
pub fn numbers(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse_macro_input!(input as DeriveInput);
    described::numbers(&input).unwrap_or_else(Error::into_compile_error).into()
}

/// The methods of a closed form's solution that are marked `#[shown]`, with their doc comments.
#[proc_macro_attribute]
pub fn functions(_: proc_macro::TokenStream, item: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let implementation = syn::parse_macro_input!(item as syn::ItemImpl);
    described::functions(implementation).unwrap_or_else(Error::into_compile_error).into()
}

/// A table: its keys, and its fields read by them.
fn of_struct(name: &Ident, fields: &Fields) -> Result<TokenStream> {
    let Fields::Named(fields) = fields else {
        return Err(Error::new_spanned(name, "the fields of a table have names"));
    };
    let (mut keys, mut reads, mut values, mut faults) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for field in &fields.named {
        let Some(ident) = &field.ident else { continue };
        let (key, ty, local) = (ident.to_string(), &field.ty, format_ident!("read_{ident}"));
        if is_flattened(field) {
            keys.push(quote!(keys.extend(<#ty as crate::document::Keys>::keys());));
            reads.push(quote!(let #local = <#ty as crate::document::Keys>::read_keys(table, reader);));
            values.push(quote!(#ident: #local?));
            continue;
        }
        let range = attribute(&field.attrs, "range").map(Attribute::parse_args::<Expr>).transpose()?;
        let range = range.map_or_else(|| quote!(None), |range| quote!(Some(#range)));
        keys.push(quote!(keys.push(#key);));
        if is_option(ty) {
            reads.push(quote!(let #local = table.optional(#key, #range, reader);));
            faults.push(
                quote!(self.#ident.as_ref().and_then(|given| crate::document::fault(#key, given, #range))),
            );
            values.push(quote!(#ident: #local));
        } else {
            reads.push(quote!(let #local = table.required(#key, #range, reader);));
            faults.push(quote!(crate::document::fault(#key, &self.#ident, #range)));
            values.push(quote!(#ident: #local?));
        }
    }
    Ok(quote! {
        impl crate::document::Keys for #name {
            fn keys() -> Vec<&'static str> {
                let mut keys = Vec::new();
                #(#keys)*
                keys
            }

            fn read_keys(table: &crate::document::TableReader<'_, '_>, reader: &mut crate::document::Reader) -> Option<Self> {
                #(#reads)*
                Some(Self { #(#values),* })
            }

            fn key_fault(&self) -> Option<(String, String)> {
                None #(.or_else(|| #faults))*
            }
        }
    })
}

/// One of several words.
fn of_words(name: &Ident, variants: &[&Variant]) -> Result<TokenStream> {
    let words = variants.iter().map(|variant| word(variant)).collect::<Result<Vec<_>>>()?;
    let idents = variants.iter().map(|variant| &variant.ident);
    Ok(quote! {
        impl crate::document::Read for #name {
            const EXPECTED: &'static str = "a name";

            fn fits(value: &crate::document::Written<'_>) -> bool {
                crate::document::is_word(value, &[#(#words),*])
            }

            fn read(value: &crate::document::Written<'_>, reader: &mut crate::document::Reader) -> crate::document::Reading<Self> {
                reader.word(value, &[#((#words, Self::#idents)),*])
            }
        }
    })
}

/// The first alternative that is of the kind of value that is given.
fn of_choice(name: &Ident, attributes: &[Attribute], variants: &[&Variant]) -> Result<TokenStream> {
    let Some(expected) = attribute(attributes, "expected") else {
        return Err(Error::new_spanned(name, "#[expected(\"...\")] says what is allowed"));
    };
    let expected: LitStr = expected.parse_args()?;
    let mut tries = Vec::new();
    for variant in variants {
        let (ident, mut fields) = (&variant.ident, variant.fields.iter());
        let (Some(Field { ty, .. }), None) = (fields.next(), fields.next()) else {
            return Err(Error::new_spanned(variant, "an alternative holds one value"));
        };
        tries.push((ident, ty));
    }
    let (idents, types): (Vec<_>, Vec<_>) = tries.into_iter().unzip();
    Ok(quote! {
        impl crate::document::Read for #name {
            const EXPECTED: &'static str = #expected;

            fn fits(value: &crate::document::Written<'_>) -> bool {
                #(<#types as crate::document::Read>::fits(value))||*
            }

            fn read(value: &crate::document::Written<'_>, reader: &mut crate::document::Reader) -> crate::document::Reading<Self> {
                #(if <#types as crate::document::Read>::fits(value) {
                    let read = <#types as crate::document::Read>::read(value, reader);
                    return read.map(Self::#idents).map_err(|instead| instead.map(Self::#idents));
                })*
                reader.wrong(value, Self::EXPECTED, Self::stand_in())
            }

            fn stand_in() -> Option<Self> {
                None #(.or_else(|| <#types as crate::document::Read>::stand_in().map(Self::#idents)))*
            }

            fn numbers(&self) -> Vec<f64> {
                match self { #(Self::#idents(value) => crate::document::Read::numbers(value)),* }
            }

            fn shown(&self) -> String {
                match self { #(Self::#idents(value) => crate::document::Read::shown(value)),* }
            }
        }
    })
}

fn attribute<'a>(attributes: &'a [Attribute], name: &str) -> Option<&'a Attribute> {
    attributes.iter().find(|attribute| attribute.path().is_ident(name))
}

fn is_flattened(field: &Field) -> bool {
    attribute(&field.attrs, "table").is_some()
}

fn is_option(ty: &Type) -> bool {
    let Type::Path(path) = ty else { return false };
    path.path.segments.last().is_some_and(|segment| segment.ident == "Option")
}

/// The word of a variant: the name that serde or schemars give it, else its own in `snake_case`.
fn word(variant: &Variant) -> Result<String> {
    let mut given = None;
    for name in ["serde", "schemars"] {
        let Some(attribute) = attribute(&variant.attrs, name) else { continue };
        attribute.parse_nested_meta(|meta| {
            let value: LitStr = meta.value()?.parse()?;
            if meta.path.is_ident("rename") {
                given = Some(value.value());
            }
            Ok(())
        })?;
    }
    Ok(given.unwrap_or_else(|| snake_case(&variant.ident.to_string())))
}

fn snake_case(name: &str) -> String {
    let mut words = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push('_');
        }
        words.extend(letter.to_lowercase());
    }
    words
}
