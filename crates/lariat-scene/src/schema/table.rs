//! The macros that declare tables and choices.

/// Declares the keys of a table, each with its default, kind, unit and meaning.
///
/// ```text
/// table! {
///     /// What the table is for.
///     struct Row("[[heading]]") {
///         /// What the key means.
///         key: f64 = 10.0, Kind::Number(POSITIVE), "m";
///     }
/// }
/// ```
///
/// The default is `required`, a value as TOML, or in parentheses what happens without the key. `struct Row` declares the type
/// that serde reads, with the constant `Row::TABLE`. `keys NAME` declares only a constant. `keys NAME for Type` does so for a
/// type of the mechanics: a field of the type that is neither a key nor listed after `without` is a compile error. `plus` adds
/// keys that are not fields, `rest` a field for their values, and `choose` says how many of the keys must be given.
macro_rules! table {
    (
        $(#[doc = $about:literal])*
        struct $Row:ident($header:literal) {
            $( $(#[doc = $meaning:literal])* $field:ident: $type:ty = $default:tt, $kind:expr $(, $unit:literal)?; )*
        }
        $(rest $rest:ident;)?
        $(plus $more:expr;)*
        $(choose $choose:expr;)?
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, serde::Deserialize)]
        pub struct $Row {
            $( $(#[doc = $meaning])* pub $field: $type, )*
            $(
                /// All other keys.
                #[serde(flatten)]
                pub $rest: toml::Table,
            )?
        }

        impl $Row {
            /// The keys of the table.
            pub const TABLE: $crate::schema::Table = $crate::schema::Table {
                header: $header,
                about: concat!($($about),*),
                keys: &[
                    &[$( $crate::schema::table!(@key $field, [$($meaning)*], $default, $kind, [$($unit)?]) ),*],
                    $($more,)*
                ],
                choose: $crate::schema::table!(@choose $($choose)?),
            };
        }
    };
    (
        $(#[doc = $about:literal])*
        keys $NAME:ident for $Type:ident($header:literal) {
            $( $(#[doc = $meaning:literal])* $field:ident = $default:tt, $kind:expr $(, $unit:literal)?; )*
        }
        $(without $hidden:ident;)*
        $(plus $more:expr;)*
        $(choose $choose:expr;)?
    ) => {
        $crate::schema::table! {
            $(#[doc = $about])*
            keys $NAME($header) { $( $(#[doc = $meaning])* $field = $default, $kind $(, $unit)?; )* }
            $(plus $more;)*
            $(choose $choose;)?
        }
        // every field has its key
        const _: fn(&$Type) = |value| { let $Type { $($field: _,)* $($hidden: _,)* } = value; };
    };
    (
        $(#[doc = $about:literal])*
        keys $NAME:ident($header:literal) {
            $( $(#[doc = $meaning:literal])* $field:ident = $default:tt, $kind:expr $(, $unit:literal)?; )*
        }
        $(plus $more:expr;)*
        $(choose $choose:expr;)?
    ) => {
        $(#[doc = $about])*
        pub const $NAME: $crate::schema::Table = $crate::schema::Table {
            header: $header,
            about: concat!($($about),*),
            keys: &[
                &[$( $crate::schema::table!(@key $field, [$($meaning)*], $default, $kind, [$($unit)?]) ),*],
                $($more,)*
            ],
            choose: $crate::schema::table!(@choose $($choose)?),
        };
    };
    (@key $field:ident, [$($meaning:literal)*], $default:tt, $kind:expr, [$($unit:literal)?]) => {
        $crate::schema::Key {
            name: stringify!($field),
            kind: $kind,
            unit: concat!($($unit)?),
            default: $crate::schema::table!(@default $default),
            meaning: concat!($($meaning),*),
        }
    };
    (@default required) => { $crate::schema::Default::Required };
    (@default ($($without:literal)?)) => { $crate::schema::Default::Absent(concat!($($without)?)) };
    (@default $value:tt) => { $crate::schema::Default::Value(stringify!($value)) };
    (@choose) => { $crate::schema::Choose::Free };
    (@choose $choose:expr) => { $choose };
}

/// Declares an enum whose values are written as texts, with their list `names`.
macro_rules! choice {
    (
        $(#[doc = $about:literal])*
        enum $Name:ident { $( $(#[doc = $meaning:literal])* $Variant:ident = $text:literal, )* }
    ) => {
        $(#[doc = $about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
        pub enum $Name { $( $(#[doc = $meaning])* #[serde(rename = $text)] $Variant, )* }

        impl $Name {
            /// Returns all names, as a scene writes them.
            pub fn names() -> Vec<&'static str> {
                vec![$($text),*]
            }

            /// Returns the name, as a scene writes it.
            pub fn name(self) -> &'static str {
                match self { $( $Name::$Variant => $text, )* }
            }
        }
    };
}

pub(crate) use {choice, table};
