//! Colours: the Okabe–Ito palette, which readers of all kinds of colour vision can tell apart.

/// A colour with its opacity, from 0 (clear) to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
    /// Opacity, 0 to 255.
    pub opacity: u8,
}

impl Colour {
    /// Blue.
    pub const BLUE: Self = Self::rgb(0x00, 0x72, 0xb2);
    /// Vermilion.
    pub const VERMILION: Self = Self::rgb(0xd5, 0x5e, 0x00);
    /// Bluish green.
    pub const GREEN: Self = Self::rgb(0x00, 0x9e, 0x73);
    /// Reddish purple.
    pub const PURPLE: Self = Self::rgb(0xcc, 0x79, 0xa7);
    /// Orange.
    pub const ORANGE: Self = Self::rgb(0xe6, 0x9f, 0x00);
    /// Sky blue.
    pub const SKY: Self = Self::rgb(0x56, 0xb4, 0xe9);
    /// Near black, for what is known to be true.
    pub const INK: Self = Self::rgb(0x1f, 0x23, 0x28);
    /// Middle grey, for raw data.
    pub const GREY: Self = Self::rgb(0x8a, 0x8f, 0x98);

    /// Light grey, for dots that fill a panel.
    pub(super) const PALE: Self = Self::rgb(0xc3, 0xc8, 0xcf);
    pub(super) const WHITE: Self = Self::rgb(0xff, 0xff, 0xff);
    pub(super) const GRID: Self = Self::rgb(0xe9, 0xeb, 0xee);
    pub(super) const AXIS: Self = Self::rgb(0x9a, 0xa0, 0xa8);
    pub(super) const LABEL: Self = Self::rgb(0x4a, 0x50, 0x58);

    /// An opaque colour.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue, opacity: 255 }
    }

    /// The same colour with another opacity, 0 to 255.
    #[must_use]
    pub const fn faded(self, opacity: u8) -> Self {
        Self { opacity, ..self }
    }

    /// The colour of the `index`th of several alike series; after seven they repeat.
    pub const fn series(index: usize) -> Self {
        match index % 7 {
            0 => Self::BLUE,
            1 => Self::VERMILION,
            2 => Self::GREEN,
            3 => Self::PURPLE,
            4 => Self::ORANGE,
            5 => Self::SKY,
            _ => Self::INK,
        }
    }
}
