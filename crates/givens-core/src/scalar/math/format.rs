//! The two float formats: what the elementary functions need to know of each.

/// Constants of a float format. They are given as `f64`, each exact or rounded once in the format itself.
pub trait Format: Copy {
    /// Bits of a float.
    const BITS: u32;
    /// Bits behind the leading one.
    const MANTISSA: u32;
    /// What the exponent field holds for 1.
    const BIAS: f64;
    /// 1.5 · 2^mantissa: added to a small number, it rounds that to a whole one.
    const MAGIC: f64;
    /// 2^s + 1 with s half of the digits: a product by it splits a float in two.
    const SPLITTER: f64;
    /// π/2 in parts so short that their products with the quarter turns of any angle up to the limit are exact; the limit.
    /// All parts are positive, so that −0 stays −0.
    const HALF_PI: (&'static [f64], f64);
    /// π/2 in parts of full length, for fused products; the limit.
    const HALF_PI_FUSED: (&'static [f64], f64);
    /// π, and what it is short of.
    const PI: (f64, f64);
    /// From here on the sum of two numbers might overflow.
    const HUGE: f64;
    /// e^x is 0 below and ∞ above.
    const EXP_RANGE: (f64, f64);
    /// ln 2 in a part whose products with exponents are exact, and the rest.
    const LN_2: (f64, f64);
    /// The least number of full precision.
    const LEAST_NORMAL: f64;
    /// A power of two that makes subnormal numbers normal, and its exponent.
    const LIFT: (f64, f64);
    /// Below, sinh x and tanh x are x.
    const TINY: f64;
    /// 2/3, and what it is short of.
    const TWO_THIRDS: (f64, f64);
    /// log₁₀ e, and what it is short of.
    const LOG10_E: (f64, f64);
    /// (above, factor) and (below, factor): where squares would overflow or lose digits, and the power of two against it.
    const HYPOT_SCALES: [(f64, f64); 2];
    /// (sin r − r) / r³ in r², |r| ≤ π/4.
    const SIN: &'static [f64];
    /// (cos r − 1 + r²/2) / r⁴ in r², |r| ≤ π/4.
    const COS: &'static [f64];
    /// (e^r − 1 − r) / r², |r| ≤ ln 2 / 2.
    const EXP: &'static [f64];
    /// (ln((1 + s)/(1 − s)) − 2 s) / s³ in s², |s| ≤ (√2 − 1)/(√2 + 1).
    const LOG: &'static [f64];
    /// The same without its first term 2/3, divided by s² once more, finer.
    const LOG_FIFTH: &'static [f64];
    /// (atan u − u) / u³ in u², |u| ≤ 0.55.
    const ATAN: &'static [f64];
    /// (asin s − s) / s³ in s², |s| ≤ 1/2.
    const ASIN: &'static [f64];

    /// To double precision.
    fn to_f64(self) -> f64;
    /// From double precision, rounded.
    fn of_f64(value: f64) -> Self;
    /// The pattern of bits.
    fn pattern(self) -> u64;
    /// The float of a pattern.
    fn of_pattern(bits: u64) -> Self;
}

/// 2^k, k within the exponents of `f64`.
const fn two_to(k: i64) -> f64 {
    f64::from_bits(((1023 + k) as u64) << 52)
}

impl Format for f64 {
    const BITS: u32 = 64;
    const MANTISSA: u32 = 52;
    const BIAS: f64 = 1023.0;
    const MAGIC: f64 = 6_755_399_441_055_744.0;
    const SPLITTER: f64 = 134_217_729.0;
    const HALF_PI: (&'static [f64], f64) = (
        &[
            1.570_796_326_734_125_6,
            6.077_100_506_303_966e-11,
            2.022_266_248_711_166_5e-21,
            8.478_427_660_368_9e-32,
        ],
        1e6,
    );
    const HALF_PI_FUSED: (&'static [f64], f64) =
        (&[core::f64::consts::FRAC_PI_2, 6.123_233_995_736_765e-17, 1.082_856_673_921_913_9e-32], 1e9);
    const PI: (f64, f64) = (core::f64::consts::PI, 1.224_646_799_147_353_2e-16);
    const HUGE: f64 = 1e300;
    const EXP_RANGE: (f64, f64) = (-746.0, 711.0);
    const LN_2: (f64, f64) = (0.693_147_180_559_890_3, 5.497_923_018_708_371e-14);
    const LEAST_NORMAL: f64 = f64::MIN_POSITIVE;
    const LIFT: (f64, f64) = (18_014_398_509_481_984.0, 54.0);
    const TINY: f64 = 1e-8;
    const TWO_THIRDS: (f64, f64) = (0.666_666_666_666_666_6, 3.700_743_415_417_188e-17);
    const LOG10_E: (f64, f64) = (core::f64::consts::LOG10_E, 1.098_319_650_216_765e-17);
    const HYPOT_SCALES: [(f64, f64); 2] = [(two_to(500), two_to(-600)), (two_to(-400), two_to(700))];
    const SIN: &'static [f64] = &[
        -0.166_666_666_666_666_66,
        0.008_333_333_333_330_946,
        -0.000_198_412_698_367_549_7,
        2.755_731_610_068_303e-06,
        -2.505_113_145_542_794_6e-08,
        1.591_810_123_027_412e-10,
    ];
    const COS: &'static [f64] = &[
        0.041_666_666_666_666_664,
        -0.001_388_888_888_888_739_5,
        2.480_158_729_876_343_3e-05,
        -2.755_731_727_056_032_6e-07,
        2.087_614_602_468_974_7e-09,
        -1.138_261_486_855_632_5e-11,
    ];
    const EXP: &'static [f64] = &[
        0.500_000_000_000_000_1,
        0.166_666_666_666_666_69,
        0.041_666_666_666_624_13,
        0.008_333_333_333_330_062,
        0.001_388_888_891_721_371_7,
        0.000_198_412_698_630_536_18,
        2.480_152_129_595_437_6e-05,
        2.755_726_845_999_706_4e-06,
        2.762_008_844_540_974_6e-07,
        2.510_038_549_551_032e-08,
    ];
    const LOG: &'static [f64] = &[
        0.666_666_666_666_667,
        0.399_999_999_998_994_44,
        0.285_714_286_260_032_7,
        0.222_222_111_302_598_78,
        0.181_828_894_556_749_47,
        0.153_317_106_182_107_73,
        0.146_165_854_248_886_23,
    ];
    const LOG_FIFTH: &'static [f64] = &[
        0.4,
        0.285_714_285_714_293_64,
        0.222_222_222_216_558_85,
        0.181_818_183_353_928_02,
        0.153_845_949_625_184_3,
        0.133_348_046_938_473_1,
        0.117_062_363_394_912_06,
        0.117_231_786_238_765_18,
    ];
    const ATAN: &'static [f64] = &[
        -0.333_333_333_333_333_3,
        0.199_999_999_999_961_1,
        -0.142_857_142_849_915,
        0.111_111_110_581_708_25,
        -0.090_909_070_682_946_83,
        0.076_922_614_810_401_68,
        -0.066_659_846_508_604_46,
        0.058_755_477_995_829_246,
        -0.052_160_576_552_232_92,
        0.045_332_287_974_467_686,
        -0.035_693_720_170_606_41,
        0.021_590_387_069_349_4,
        -0.007_061_098_976_163_003,
    ];
    const ASIN: &'static [f64] = &[
        0.166_666_666_666_666_69,
        0.074_999_999_999_984_25,
        0.044_642_857_146_373_38,
        0.030_381_944_137_085_216,
        0.022_372_173_002_005_596,
        0.017_352_391_265_909_227,
        0.013_971_235_301_124_539,
        0.011_478_952_690_257_387,
        0.010_324_318_288_744_113,
        0.005_450_878_187_720_55,
        0.017_419_357_964_884_856,
        -0.014_881_409_392_818_066,
        0.028_778_442_612_593_04,
    ];

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn of_f64(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn pattern(self) -> u64 {
        self.to_bits()
    }
    #[inline(always)]
    fn of_pattern(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

impl Format for f32 {
    const BITS: u32 = 32;
    const MANTISSA: u32 = 23;
    const BIAS: f64 = 127.0;
    const MAGIC: f64 = 12_582_912.0;
    const SPLITTER: f64 = 4097.0;
    const HALF_PI: (&'static [f64], f64) = (
        &[
            1.570_556_640_625,
            0.000_239_670_276_641_845_7,
            1.589_069_142_937_660_2e-8,
            2.563_282_919_254_561_4e-12,
            6.123_233_601_181_349e-17,
        ],
        2000.0,
    );
    const HALF_PI_FUSED: (&'static [f64], f64) =
        (&[1.570_796_251_296_997, 7.549_789_415_861_596e-8, 5.390_302_529_957_765e-15], 6e4);
    const PI: (f64, f64) = (3.141_592_741_012_573_2, -8.742_277_657_347_586e-8);
    const HUGE: f64 = 1e37;
    const EXP_RANGE: (f64, f64) = (-105.0, 90.0);
    const LN_2: (f64, f64) = (0.693_145_751_953_125, 1.428_606_765_330_187e-6);
    const LEAST_NORMAL: f64 = f32::MIN_POSITIVE as f64;
    const LIFT: (f64, f64) = (33_554_432.0, 25.0);
    const TINY: f64 = 2e-4;
    const TWO_THIRDS: (f64, f64) = (0.666_666_686_534_881_6, -1.986_821_551_724_915_5e-8);
    const LOG10_E: (f64, f64) = (0.434_294_492_006_301_9, -1.010_304_995_219_257_8e-8);
    const HYPOT_SCALES: [(f64, f64); 2] = [(two_to(60), two_to(-90)), (two_to(-40), two_to(100))];
    const SIN: &'static [f64] =
        &[-0.166_666_666_6, 0.008_333_331_874, -0.000_198_400_862_6, 2.724_986_466e-6];
    const COS: &'static [f64] = &[0.041_666_664_66, -0.001_388_830_28, 2.454_789_162e-5];
    const EXP: &'static [f64] = &[
        0.500_000_001_3,
        0.166_666_666_8,
        0.041_666_464_93,
        0.008_333_310_925,
        0.001_393_365,
        0.000_198_909_908_2,
    ];
    const LOG: &'static [f64] = &[0.666_666_850_5, 0.399_887_782_8, 0.295_800_530_4];
    const LOG_FIFTH: &'static [f64] = &[0.399_999_999, 0.285_715_318_2, 0.222_047_620_9, 0.191_204_548_1];
    const ATAN: &'static [f64] = &[
        -0.333_333_321_2,
        0.199_997_110_5,
        -0.142_743_659_3,
        0.109_447_938_3,
        -0.079_490_290_99,
        0.037_666_380_88,
    ];
    const ASIN: &'static [f64] = &[
        0.166_666_663_4,
        0.075_000_947_61,
        0.044_599_319_16,
        0.031_101_727_83,
        0.017_143_716_82,
        0.033_700_726_32,
    ];

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn of_f64(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn pattern(self) -> u64 {
        u64::from(self.to_bits())
    }
    #[inline(always)]
    fn of_pattern(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }
}
