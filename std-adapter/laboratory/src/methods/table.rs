//! The common part of all lists of methods.

/// Declares an enum whose variants are rows: a name on the command line and in reports, and a value.
macro_rules! table {
    (
        $(#[$enum_doc:meta])*
        pub enum $table:ident of $row:ty {
            $($(#[$doc:meta])* $variant:ident = $name:literal: $stands_for:expr,)+
        }
    ) => {
        $(#[$enum_doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $table {
            $($(#[$doc])* $variant,)+
        }

        impl $table {
            /// Every row, in order.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Returns the name on the command line and in reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            const fn row(self) -> $row {
                match self {
                    $(Self::$variant => $stands_for,)+
                }
            }
        }

        impl std::fmt::Display for $table {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }
    };
}
pub(super) use table;
