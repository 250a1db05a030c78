//! What a program without an allocator must not have among its symbols.

/// A function or a constant of a program, or one that it imports.
pub struct Symbol {
    /// As the linker has it: Rust's names mangled.
    pub name: String,
    /// Bytes; zero for what is imported.
    pub size: u64,
    /// Whether it must come from a library.
    pub imported: bool,
}

/// Functions that give memory, or take it back.
const ALLOCATORS: &[&str] = &[
    "malloc",
    "calloc",
    "realloc",
    "reallocarray",
    "free",
    "cfree",
    "memalign",
    "aligned_alloc",
    "posix_memalign",
    "valloc",
    "pvalloc",
    "brk",
    "sbrk",
    "mmap",
];

/// What the compiler makes calls of allocators to.
const RUST_ALLOCATORS: &[&str] =
    &["__rust_alloc", "__rust_dealloc", "__rust_realloc", "__rust_no_alloc_shim", "__rdl_", "__rg_"];

/// What the program may ask of the C library: its start, its output, its end, and what the compiler itself calls to move
/// bytes.
const IMPORTED: &[&str] =
    &["__libc_start_main", "write", "_exit", "memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// What is wrong with the symbols of a program, a sentence each.
pub fn unwanted(symbols: &[Symbol]) -> Vec<String> {
    let mut found: Vec<String> = symbols.iter().filter_map(fault).collect();
    found.sort();
    found.dedup();
    found
}

/// What the program imports, each once.
pub fn imported(symbols: &[Symbol]) -> Vec<&str> {
    let mut names: Vec<&str> =
        symbols.iter().filter(|symbol| symbol.imported).map(|symbol| symbol.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

fn fault(symbol: &Symbol) -> Option<String> {
    let name = symbol.name.as_str();
    let crates = crates(name);
    let why = if ALLOCATORS.contains(&name)
        || RUST_ALLOCATORS.iter().any(|mark| name.contains(mark))
        || crates.contains(&"alloc")
    {
        "allocates"
    } else if crates.contains(&"std") {
        "is of the standard library"
    } else if ["4core3fmt", "core..fmt.."].iter().any(|path| name.contains(path)) {
        "formats: look for `{}` or `unwrap` on its way"
    } else if symbol.imported && !IMPORTED.contains(&name) {
        "is imported, and not among what the program may ask of the C library"
    } else {
        return None;
    };
    Some(format!("`{name}` {why}"))
}

/// The crates that a mangled name names, in its order. Of both manglings: `_ZN4core3fmt`, `$LT$core..fmt`, `Csh4sh_4core`.
pub fn crates(name: &str) -> Vec<&'static str> {
    const KNOWN: &[&str] =
        &["givens_core", "tracker", "libm", "host", "core", "compiler_builtins", "alloc", "std"];
    let mut found: Vec<(usize, &'static str)> = Vec::new();
    for known in KNOWN {
        let length = known.len();
        let forms = [format!("_ZN{length}{known}"), format!("${known}.."), format!("_{length}{known}")];
        found.extend(forms.iter().filter_map(|form| name.find(form.as_str())).map(|at| (at, *known)));
    }
    found.sort_unstable();
    found.into_iter().map(|(_, known)| known).collect()
}

#[cfg(test)]
mod tests {
    use super::{Symbol, crates, imported, unwanted};

    fn symbols(names: &[(&str, bool)]) -> Vec<Symbol> {
        names.iter().map(|&(name, imported)| Symbol { name: name.to_owned(), size: 8, imported }).collect()
    }

    #[test]
    fn what_a_filter_is_made_of_is_no_fault() {
        let good = symbols(&[
            ("main", false),
            ("_ZN11givens_core7kernels4tria7echelon17h0123456789abcdefE", false),
            (
                "_ZN77_$LT$tracker..plane..Turn$u20$as$u20$givens_core..model..Transition$GT$5noise17h01E",
                false,
            ),
            ("_ZN4core9panicking18panic_bounds_check17h01E", false),
            ("__libc_start_main", true),
            ("memcpy", true),
        ]);
        assert_eq!(unwanted(&good), [""; 0]);
        assert_eq!(imported(&good), ["__libc_start_main", "memcpy"]);
    }

    #[test]
    fn every_way_to_an_allocator_is_found() {
        for name in [
            "malloc",
            "free",
            "posix_memalign",
            "__rust_alloc",
            "_RNvCs1_7___rustc35___rust_no_alloc_shim_is_unstable_v2",
            "_ZN5alloc7raw_vec17capacity_overflow17h01E",
            "_ZN65_$LT$alloc..vec..Vec$LT$T$GT$$u20$as$u20$core..ops..drop..Drop$GT$4drop17h01E",
            "_RNvMs_NtCs9_5alloc3vecINtB4_3VecfE4push",
        ] {
            for imported in [false, true] {
                let found = unwanted(&symbols(&[("main", false), (name, imported)]));
                assert_eq!(found, [format!("`{name}` allocates")]);
            }
        }
    }

    #[test]
    fn std_and_formatting_and_strange_imports_are_found() {
        for (name, imported, why) in [
            ("_ZN3std2rt10lang_start17h01E", false, "is of the standard library"),
            ("_ZN4core3fmt5write17h01E", false, "formats"),
            ("_ZN52_$LT$f32$u20$as$u20$core..fmt..Debug$GT$3fmt17h01E", false, "formats"),
            ("printf", true, "is imported"),
        ] {
            let found = unwanted(&symbols(&[(name, imported)]));
            assert!(found.len() == 1 && found[0].contains(why), "{name}: {found:?}");
        }
    }

    #[test]
    fn the_first_crate_of_a_name_owns_it() {
        let name = "_ZN77_$LT$tracker..plane..Turn$u20$as$u20$givens_core..model..Transition$GT$5noise17h01E";
        assert_eq!(crates(name), ["tracker", "givens_core"]);
        assert_eq!(crates("_RNvNtCsh4sh_11givens_core7kernels4tria"), ["givens_core"]);
        assert_eq!(crates("_start"), [""; 0]);
    }
}
