//! The families of GPUs whose compilers can be asked, and those that cannot.

use super::figures::StatisticNames;

/// A family of GPUs.
#[derive(Debug)]
pub struct Family {
    /// Its name on the command line and in reports.
    pub name: &'static str,
    /// Its vendor.
    pub vendor: &'static str,
    /// The GPU that stands for it.
    pub gpu: &'static str,
    /// Its compiler.
    pub compiler: GpuCompiler,
    /// The compiler's names of its figures.
    pub columns: StatisticNames,
    /// Whether it computes in 16 bits where a text says so. In OpenGL ES that is left to the driver.
    pub half: bool,
}

/// The compiler of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GpuCompiler {
    /// No compiler: the operations of the function are counted.
    Operations,
    /// RADV, Mesa's driver for AMD GPUs, as distributions package it, told to emulate this family.
    Radv(&'static str),
    /// A compiler of Mesa's that tests/mesa-compilers builds.
    Mesa {
        /// The library that stands in for the kernel driver.
        shim: &'static str,
        /// Variables that select the GPU, and make the compiler report statistics.
        environment: &'static [(&'static str, &'static str)],
        /// Its input language.
        dialect: Dialect,
    },
    /// No compiler is available, and why.
    None(&'static str),
}

/// The input language of a compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// SPIR-V from WGSL.
    Wgsl,
    /// GLSL ES 3.00.
    Es300,
    /// GLSL ES 1.00.
    Es100,
}

impl Dialect {
    /// The number of evaluations in the shorter chain and in the longer one. GPUs of OpenGL ES 2.0 take programs of a few hundred
    /// instructions at most.
    pub fn chains(self) -> [usize; 2] {
        match self {
            Dialect::Wgsl | Dialect::Es300 => [4, 8],
            Dialect::Es100 => [1, 2],
        }
    }
}

impl GpuCompiler {
    /// The compiler's input language, where there is a compiler.
    pub fn dialect(self) -> Option<Dialect> {
        match self {
            GpuCompiler::Radv(_) => Some(Dialect::Wgsl),
            GpuCompiler::Mesa { dialect, .. } => Some(dialect),
            GpuCompiler::Operations | GpuCompiler::None(_) => None,
        }
    }
}

/// The family of this name.
pub fn find(name: &str) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.name == name)
}

const RADV: StatisticNames = StatisticNames {
    instructions: "Instructions",
    latency: Some("Latency"),
    inverse_throughput: &["Inverse Throughput"],
    registers: Some("VGPRs"),
    measure: "inverse throughput",
};

const fn amd(name: &'static str, gpu: &'static str, chip: &'static str) -> Family {
    Family {
        name,
        vendor: "AMD",
        gpu,
        compiler: GpuCompiler::Radv(chip),
        columns: RADV,
        half: true,
    }
}

const fn mesa(
    (name, vendor, gpu): (&'static str, &'static str, &'static str),
    shim: &'static str,
    environment: &'static [(&'static str, &'static str)],
    dialect: Dialect,
    columns: StatisticNames,
) -> Family {
    Family {
        name,
        vendor,
        gpu,
        compiler: GpuCompiler::Mesa {
            shim,
            environment,
            dialect,
        },
        columns,
        half: true,
    }
}

/// The statistics that all of Mesa's drivers report.
const INSTRUCTIONS: StatisticNames = StatisticNames {
    instructions: "inst",
    latency: None,
    inverse_throughput: &[],
    registers: None,
    measure: "instructions",
};

const fn adreno(
    (name, gpu): (&'static str, &'static str),
    environment: &'static [(&'static str, &'static str)],
) -> Family {
    let columns = StatisticNames {
        registers: Some("full"),
        ..INSTRUCTIONS
    };
    let about = (name, "Qualcomm", gpu);
    mesa(about, "freedreno", environment, Dialect::Es300, columns)
}

const fn intel(
    (name, gpu): (&'static str, &'static str),
    environment: &'static [(&'static str, &'static str)],
) -> Family {
    let columns = StatisticNames {
        latency: Some("cycles"),
        ..INSTRUCTIONS
    };
    let about = (name, "Intel", gpu);
    mesa(about, "intel", environment, Dialect::Es300, columns)
}

const fn nvidia(
    (name, gpu): (&'static str, &'static str),
    environment: &'static [(&'static str, &'static str)],
) -> Family {
    let columns = StatisticNames {
        registers: Some("gpr"),
        ..INSTRUCTIONS
    };
    let about = (name, "NVIDIA", gpu);
    mesa(about, "nouveau", environment, Dialect::Es300, columns)
}

/// All families, in the order of reports.
pub static FAMILIES: &[Family] = &[
    Family {
        name: "operations",
        vendor: "none",
        gpu: "scalar operations of the formula, before any compiler",
        compiler: GpuCompiler::Operations,
        columns: StatisticNames {
            measure: "operations",
            ..INSTRUCTIONS
        },
        half: true,
    },
    Family {
        half: false,
        ..amd("gcn4", "GCN 4, Polaris 10", "polaris10")
    },
    amd("rdna1", "RDNA 1, Navi 10", "navi10"),
    amd("rdna2", "RDNA 2, Navi 21", "navi21"),
    amd("rdna3", "RDNA 3, Navi 31", "gfx1100"),
    adreno(
        ("adreno320", "Adreno 320"),
        &[("FD_GPU_ID", "320"), ("FD_MESA_DEBUG", "shaderdb")],
    ),
    adreno(
        ("adreno330", "Adreno 330"),
        &[("FD_GPU_ID", "330"), ("FD_MESA_DEBUG", "shaderdb")],
    ),
    adreno(
        ("adreno530", "Adreno 530"),
        &[("FD_GPU_ID", "530"), ("FD_MESA_DEBUG", "shaderdb")],
    ),
    adreno(
        ("adreno630", "Adreno 630"),
        &[("FD_GPU_ID", "630"), ("FD_MESA_DEBUG", "shaderdb")],
    ),
    mesa(
        (
            "mali450",
            "Arm",
            "Mali-450, Utgard, the family of the Mali-400",
        ),
        "lima",
        &[("LIMA_DEBUG", "shaderdb,precompile")],
        Dialect::Es100,
        INSTRUCTIONS,
    ),
    mesa(
        ("malit860", "Arm", "Mali-T860, Midgard"),
        "panfrost",
        &[("PAN_GPU_ID", "860"), ("PAN_MESA_DEBUG", "precompile")],
        Dialect::Es300,
        StatisticNames {
            inverse_throughput: &["bundles"],
            registers: Some("registers"),
            measure: "bundles",
            ..INSTRUCTIONS
        },
    ),
    mesa(
        ("malig72", "Arm", "Mali-G72, Bifrost"),
        "panfrost",
        &[("PAN_GPU_ID", "6221"), ("BIFROST_MESA_DEBUG", "shaderdb")],
        Dialect::Es300,
        StatisticNames {
            inverse_throughput: &["arith"],
            measure: "cycles of arithmetic",
            ..INSTRUCTIONS
        },
    ),
    mesa(
        ("malig57", "Arm", "Mali-G57, Valhall"),
        "panfrost",
        &[("PAN_GPU_ID", "9093"), ("BIFROST_MESA_DEBUG", "shaderdb")],
        Dialect::Es300,
        StatisticNames {
            inverse_throughput: &["fma", "cvt", "sfu", "t", "ls"],
            measure: "cycles of the busiest pipe",
            ..INSTRUCTIONS
        },
    ),
    intel(
        ("hd4000", "HD Graphics 4000, generation 7"),
        &[("INTEL_STUB_GPU_PLATFORM", "ivb")],
    ),
    intel(
        ("hd530", "HD Graphics 530, generation 9"),
        &[("INTEL_STUB_GPU_PLATFORM", "skl")],
    ),
    intel(
        ("xe", "Xe, Tiger Lake, generation 12"),
        &[("INTEL_STUB_GPU_PLATFORM", "tgl")],
    ),
    nvidia(("kepler", "GK110, Kepler"), &[("NOUVEAU_CHIPSET", "f0")]),
    nvidia(("maxwell", "GM204, Maxwell"), &[("NOUVEAU_CHIPSET", "124")]),
    mesa(
        ("videocore6", "Broadcom", "VideoCore VI, Raspberry Pi 4"),
        "v3d",
        &[("V3D_DEBUG", "precompile,shaderdb")],
        Dialect::Es300,
        StatisticNames {
            registers: Some("max-temps"),
            ..INSTRUCTIONS
        },
    ),
    mesa(
        ("gc2000", "Vivante", "GC2000"),
        "etnaviv",
        &[("ETNA_SHIM_GPU", "GC2000"), ("ETNA_MESA_DEBUG", "shaderdb")],
        Dialect::Es100,
        StatisticNames {
            instructions: "instructions",
            registers: Some("temps"),
            ..INSTRUCTIONS
        },
    ),
    Family {
        name: "powervr",
        vendor: "Imagination",
        gpu: "PowerVR G6430, Rogue",
        compiler: GpuCompiler::None(
            "Mesa has no compiler for this generation of PowerVR, and the vendor's own is not free to run in a build",
        ),
        columns: INSTRUCTIONS,
        half: true,
    },
];
