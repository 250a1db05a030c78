//! Any small model, its sensors, its prior and its data.

use crate::bytes::Bytes;
use givens::Data;
use givens::filter::Gaussian;
use givens::registry::Kind;
use givens_expr::{
    Binary, Graph, Input, ModelObservation, ModelSde, ModelTransition, Node, NoiseBlock, ObservationParts,
    SdeParts, TransitionParts, Unary,
};

/// How the state moves.
pub(crate) enum Moves {
    Discrete(ModelTransition),
    Continuous(ModelSde),
}

/// A model and its sensors.
pub(crate) struct World {
    pub moves: Moves,
    pub sensors: ModelObservation,
    pub states: usize,
    pub measures: usize,
    pub controls: usize,
    pub parameters: usize,
    pub period: Option<f64>,
}

const UNARY: [Unary; 20] = [
    Unary::Neg,
    Unary::Abs,
    Unary::Sign,
    Unary::Floor,
    Unary::Sqrt,
    Unary::Exp,
    Unary::Log,
    Unary::Log10,
    Unary::Sin,
    Unary::Cos,
    Unary::Tan,
    Unary::Asin,
    Unary::Acos,
    Unary::Atan,
    Unary::Sinh,
    Unary::Cosh,
    Unary::Tanh,
    Unary::Erf,
    Unary::Erfc,
    Unary::Not,
];

const BINARY: [Binary; 15] = [
    Binary::Add,
    Binary::Sub,
    Binary::Mul,
    Binary::Div,
    Binary::Pow,
    Binary::Atan2,
    Binary::Hypot,
    Binary::Min,
    Binary::Max,
    Binary::Less,
    Binary::LessEqual,
    Binary::Equal,
    Binary::And,
    Binary::Or,
    Binary::Scale,
];

impl World {
    /// A model with up to four states, three measures, two controls and two parameters; none where it is refused.
    pub fn any(bytes: &mut Bytes, kind: Kind) -> Option<Self> {
        let (n, d) = (1 + bytes.below(4), 1 + bytes.below(3));
        let (controls, parameters) = (bytes.below(8).saturating_sub(5), bytes.below(8).saturating_sub(5));
        let mut make = Make { graph: Graph::new(), still: Vec::new(), moving: Vec::new(), bytes };
        make.inputs(n, controls, parameters, kind == Kind::Discrete);
        let values = make.bytes.plains(parameters);
        let period = (kind == Kind::Discrete && make.bytes.below(8) == 7).then(|| make.bytes.plain());
        let moves = match kind {
            Kind::Discrete => {
                let next = make.moved(n);
                let noise_cov = if make.bytes.below(4) == 3 { Vec::new() } else { make.covariance(n) };
                let parts = TransitionParts {
                    states: n,
                    controls,
                    parameters: values.clone(),
                    period,
                    next,
                    noise_cov,
                };
                Moves::Discrete(refused(ModelTransition::new(&mut make.graph, parts))?)
            }
            Kind::Continuous => {
                let drift = make.moved(n);
                let noises = make.bytes.below(n + 1);
                let diffusion = make.diffusion(n, noises);
                let parts =
                    SdeParts { states: n, controls, parameters: values.clone(), drift, diffusion, noises };
                Moves::Continuous(refused(ModelSde::new(&mut make.graph, parts))?)
            }
        };
        let step = make.graph.input(Input::Step);
        make.still.retain(|node| *node != step);
        let measures = (0..d).map(|i| make.measured(i, n)).collect();
        let angles = (0..d).map(|_| (make.bytes.below(8) == 7).then(|| make.bytes.plain())).collect();
        let noise = if make.bytes.flag() {
            NoiseBlock::Cov(make.covariance(d))
        } else {
            NoiseBlock::Std(make.stds(d))
        };
        let parts =
            ObservationParts { states: n, controls, parameters, measures, angles, noise: vec![noise] };
        let sensors = refused(ModelObservation::new(&mut make.graph, parts))?;
        Some(Self { moves, sensors, states: n, measures: d, controls, parameters, period })
    }

    /// A prior; none where its covariance is refused.
    pub fn prior(&self, bytes: &mut Bytes) -> Option<Gaussian> {
        // now and then of another length than the model's
        let n = if bytes.byte() == 255 { bytes.below(6) } else { self.states };
        let mean = bytes.plains(n);
        match bytes.below(4) {
            0 => refused(Gaussian::from_cov(&mean, &bytes.plains(n * n))),
            1 => {
                let root = bytes.plains(n * n);
                let product = |i: usize, j: usize| (0..n).map(|k| root[i * n + k] * root[j * n + k]).sum();
                let cov: Vec<f64> = (0..n * n).map(|k| product(k / n, k % n)).collect();
                refused(Gaussian::from_cov(&mean, &cov))
            }
            _ => {
                let std: Vec<f64> = bytes.plains(n).iter().map(|std| std.abs()).collect();
                refused(Gaussian::from_std(&mean, &std))
            }
        }
    }

    /// Whether `time` is reached soon: a model of a fixed step takes all the steps that lie between.
    pub fn near(&self, time: f64) -> bool {
        self.period.is_none_or(|period| (time / period).abs() <= 200.0)
    }

    /// Up to six rows; those that are refused are left out.
    pub fn data(&self, bytes: &mut Bytes) -> Data {
        // now and then of other lengths than the model's
        let odd = bytes.byte() == 255;
        let (measures, controls) =
            if odd { (bytes.below(5), bytes.below(4)) } else { (self.measures, self.controls) };
        let mut data = Data::with_controls(measures, controls);
        let mut time = 0.0;
        if bytes.flag() {
            time = bytes.plain();
            data = data.starting_at(time);
        }
        for _ in 0..bytes.below(7) {
            time += match (self.period, bytes.byte()) {
                (Some(period), gap) if gap < 240 => f64::from(gap % 4) * period,
                (None, gap) if gap < 200 => f64::from(gap) / 40.0,
                _ => bytes.number(),
            };
            if !self.near(time) {
                break;
            }
            let z: Vec<f64> =
                (0..measures).map(|_| if bytes.below(5) == 4 { f64::NAN } else { bytes.plain() }).collect();
            let u = bytes.plains(controls);
            if let Err(error) = data.push_controlled(time, &z, &u) {
                assert!(!error.to_string().is_empty());
                time = data.rows().last().map_or(data.start(), |row| row.time);
            }
        }
        data
    }
}

/// What was made, or nothing after a refusal in words.
pub(crate) fn refused<T, E: std::fmt::Display>(made: Result<T, E>) -> Option<T> {
    made.inspect_err(|error| assert!(!error.to_string().is_empty())).ok()
}

/// Expressions in the making: those that depend on the state, and the others.
struct Make<'b, 'd> {
    graph: Graph,
    still: Vec<Node>,
    moving: Vec<Node>,
    bytes: &'b mut Bytes<'d>,
}

impl Make<'_, '_> {
    fn inputs(&mut self, n: usize, controls: usize, parameters: usize, step: bool) {
        self.moving = (0..n as u32).map(|i| self.graph.input(Input::State(i))).collect();
        let constants: Vec<f64> = self.bytes.plains(2);
        self.still = constants.into_iter().map(|value| self.graph.constant(value)).collect();
        self.still.push(self.graph.input(Input::Time));
        if step {
            self.still.push(self.graph.input(Input::Step));
        }
        self.still.extend((0..controls as u32).map(|i| self.graph.input(Input::Control(i))));
        self.still.extend((0..parameters as u32).map(|i| self.graph.input(Input::Parameter(i))));
        for _ in 0..self.bytes.below(12) {
            self.operation();
        }
    }

    /// One more expression of those that there are.
    fn operation(&mut self) {
        let still = self.bytes.below(4) == 0;
        let pool: Vec<Node> =
            if still { self.still.clone() } else { self.moving.iter().chain(&self.still).copied().collect() };
        let mut pick = || pool[self.bytes.below(pool.len())];
        let (a, b, c) = (pick(), pick(), pick());
        let node = match self.bytes.below(48) {
            i @ 0..20 => self.graph.unary(UNARY[i], a),
            i @ 20..35 => self.graph.binary(BINARY[i - 20], a, b),
            35..38 => self.graph.select(c, a, b),
            38 => self.graph.power(a, i32::from(self.bytes.byte()) - 40),
            39..44 => self.graph.mul(a, b),
            _ => self.graph.add(a, b),
        };
        if still { self.still.push(node) } else { self.moving.push(node) }
    }

    fn still(&mut self) -> Node {
        match self.bytes.byte() {
            byte @ 128.. => self.graph.constant(f64::from(byte - 128) / 32.0),
            byte => self.still[usize::from(byte) % self.still.len()],
        }
    }

    fn moving(&mut self) -> Node {
        self.moving[self.bytes.below(self.moving.len())]
    }

    /// Where the states go: anywhere, or near where they are.
    fn moved(&mut self, n: usize) -> Vec<Node> {
        let one = |make: &mut Self, i: u32| {
            let (state, other) = (make.graph.input(Input::State(i)), make.moving());
            match make.bytes.below(4) {
                0 => state,
                1 => other,
                _ => {
                    let tenth = make.graph.constant(0.1);
                    let part = make.graph.mul(tenth, other);
                    make.graph.add(state, part)
                }
            }
        };
        (0..n as u32).map(|i| one(self, i)).collect()
    }

    fn measured(&mut self, i: usize, n: usize) -> Node {
        if self.bytes.flag() { self.moving() } else { self.graph.input(Input::State((i % n) as u32)) }
    }

    fn stds(&mut self, d: usize) -> Vec<Node> {
        (0..d).map(|_| self.still()).collect()
    }

    /// A covariance of independent numbers, one that is a square, or any matrix.
    fn covariance(&mut self, n: usize) -> Vec<Node> {
        let zero = self.graph.constant(0.0);
        match self.bytes.below(4) {
            0 => (0..n * n).map(|_| self.still()).collect(),
            1 => {
                let root: Vec<Node> = (0..n * n).map(|_| self.still()).collect();
                let mut product = |i: usize, j: usize| {
                    (0..n).fold(zero, |sum, k| {
                        let part = self.graph.mul(root[i * n + k], root[j * n + k]);
                        self.graph.add(sum, part)
                    })
                };
                (0..n * n).map(|k| product(k / n, k % n)).collect()
            }
            _ => (0..n * n).map(|k| if k % (n + 1) == 0 { self.still() } else { zero }).collect(),
        }
    }

    /// G, now and then of the state.
    fn diffusion(&mut self, n: usize, noises: usize) -> Vec<Node> {
        let zero = self.graph.constant(0.0);
        let one = |make: &mut Self| match make.bytes.byte() {
            0..100 => zero,
            100..240 => make.still(),
            240.. => make.moving(),
        };
        (0..n * noises).map(|_| one(self)).collect()
    }
}
