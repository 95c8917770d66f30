//! Metals at the thesis's three wavelengths with all their digits: the two that it rounds in Table 1, and others to
//! test what it says of metals in general.
//!
//! n and k are interpolated linearly between the rows of the named pages of <https://refractiveindex.info> (CC0).

use crate::materials::Channels;

/// A metal: its name and source, and n and k at 685, 535 and 475 nm.
pub struct Metal {
    /// The element and its source.
    pub name: &'static str,
    /// Real parts.
    pub n: [f64; 3],
    /// Extinction coefficients.
    pub k: [f64; 3],
}

/// Hagemann 1975: gold before Table 1 rounded it.
pub const GOLD: Metal = Metal {
    name: "Au Hagemann-2",
    n: [0.234607, 0.567285, 1.3931],
    k: [3.94415, 2.18579, 1.72613],
};

/// Rakić 1998, Brendel-Bormann model: platinum before Table 1 rounded it.
pub const PLATINUM: Metal = Metal {
    name: "Pt Rakic-BB",
    n: [2.48707, 2.04583, 1.902],
    k: [4.4425, 3.62894, 3.28094],
};

/// Johnson and Christy 1972 and 1974, Rakić 1998 (Brendel-Bormann), Inagaki 1976, Weaver 1981.
pub const OTHERS: [Metal; 6] = [
    Metal {
        name: "Ag Johnson",
        n: [0.0443333, 0.0550903, 0.05],
        k: [4.68417, 3.45736, 2.90191],
    },
    Metal {
        name: "Al Rakic-BB",
        n: [1.55062, 0.912333, 0.701111],
        k: [7.87463, 6.24113, 5.58824],
    },
    Metal {
        name: "Cr Johnson",
        n: [3.06689, 3.06, 2.5484],
        k: [3.36889, 3.33, 3.2496],
    },
    Metal {
        name: "Cu Johnson",
        n: [0.214333, 1.09856, 1.24559],
        k: [4.00653, 2.59222, 2.4949],
    },
    Metal {
        name: "Na Inagaki",
        n: [0.0418667, 0.0547727, 0.0695222],
        k: [2.94, 2.20636, 1.87111],
    },
    Metal {
        name: "W Weaver",
        n: [3.81833, 3.50055, 3.34384],
        k: [2.90384, 2.72184, 2.60901],
    },
];

impl Metal {
    /// Red, green and blue.
    pub fn channels(&self) -> Channels {
        Channels {
            n: self.n,
            k: self.k,
        }
    }
}
