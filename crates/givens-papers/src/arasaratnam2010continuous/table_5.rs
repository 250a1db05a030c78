//! Table V: what the square-root filter costs, counted while it runs, without the functions of the model.

use super::counted::{Count, Counted, counted, uncounted};
use super::runs::scene;
use super::statements::Statements;
use crate::drawing::{COLOURS, axis, figure};
use crate::estimate::exactly;
use crate::page::Table;
use crate::radar::Radar;
use crate::{Claim, Page, Plan, Trouble};
use givens::filter::{Block, Filter, Gaussian, Method, Over, Prior, SrCdCkf};
use givens::model::zoo::Turn3d;
use givens::model::{At, Noise, Observation, Sde, Varies};
use givens::scalar::Real;
use givens_io::figure::{Figure, Mark, Panel, Scale, Shape};

/// A model or a sensor whose functions are not counted.
struct Silent<M>(M);

impl Sde for Silent<Turn3d> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn noises(&self) -> usize {
        self.0.noises()
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        uncounted(|| self.0.drift(at, x, dx));
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        uncounted(|| self.0.diffusion(at, x, g));
    }
    fn diffusion_varies(&self) -> Varies {
        self.0.diffusion_varies()
    }
    fn expansion_scratch(&self, points: usize) -> usize {
        self.0.expansion_scratch(points)
    }
    fn expansion_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        f: &mut [T],
        l0: &mut [T],
        lf: &mut [T],
        scratch: &mut [T],
    ) {
        uncounted(|| self.0.expansion_points(at, points, x, f, l0, lf, scratch));
    }
}

impl Observation for Silent<Radar> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn measures(&self) -> usize {
        self.0.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i)
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], z: &mut [T]) {
        uncounted(|| self.0.observe(at, x, z));
    }
    fn noise(&self) -> Noise {
        self.0.noise()
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        uncounted(|| self.0.measurement_noise(at, out));
    }
}

/// The time update of one step, and the measurement update, of the paper's seven states and three measures.
fn costs(block: Block) -> Result<(Count, Count), Trouble> {
    let scene = scene(7e-4, 6.0, 4.0);
    let (turn, radar) = (Silent(scene.turn), Silent(scene.radar));
    let method = SrCdCkf { substeps: 1, update: block, ..SrCdCkf::default() };
    let begin = scene.begin();
    let belief = Gaussian::from_std(&begin, &[100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 0.02])?;
    let sizes = Over::<Silent<Turn3d>>::sizes(&method, &turn).map_err(|fault| givens::filter::StepError {
        fault,
        time: 0.0,
        step: 0,
    })?;
    let sizes = sizes.with_sensor(&radar, givens::rule::Rule::shape(&method.rule(), 7));
    let len = Filter::<_, Silent<Turn3d>, Counted, Vec<Counted>>::memory_len(&method, sizes, false);
    let prior = Prior { time: 0.0, mean: belief.mean(), factor: belief.factor(), cov: belief.cov() };
    let mut filter = Filter::start_in(method, &turn, sizes, false, prior, vec![Counted(0.0); len])?;
    let (predict, done) = counted(|| filter.predict(scene.interval));
    done?;
    let at = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
    let mut z = [0.0; 3];
    scene.radar.observe(&at, &core::array::from_fn::<_, 7, _>(|i| filter.mean()[i].0), &mut z);
    let (update, done) = counted(|| filter.update(&radar, &z));
    done?;
    Ok((predict, update))
}

const REMARK: &str = "of our programs: the joint one sweeps rotations over a factor that is triangular already, the separate one \
                      carries its reflections to a whole identity (docs/algorithms.md U2, U3); neither multiplies out what the \
                      paper prints";

pub(super) fn run(_: &Plan) -> Result<Page, Trouble> {
    let ((predict, joint), (_, separate)) = (costs(Block::Joint)?, costs(Block::Separate)?);
    let columns =
        ["step", "flops", "additions", "multiplications", "divisions", "roots", "comparisons", "functions"];
    let mut table = Table::new("operations", &columns);
    for (name, count) in [
        ("time update, one step", predict),
        ("measurement update, one triangularisation (2010 eq 36)", joint),
        ("measurement update, separate (2009 Appendix B)", separate),
    ] {
        let numbers = [
            count.flops(),
            count.additions,
            count.multiplications,
            count.divisions,
            count.roots,
            count.comparisons,
            count.functions,
        ];
        let mut row = vec![name.into()];
        row.extend(numbers.map(|number| crate::page::Cell::from(number as usize)));
        table.rows.push(row);
    }
    let ratio = joint.flops() as f64 / separate.flops() as f64;
    let statements = Statements::read()?;
    let (says, page) = statements.of("costs")?;
    let same = Claim::statement(
        format!("{says} (judged: within a factor of 1.5)"),
        format!("{} flops against {}, {:.2} times", joint.flops(), separate.flops(), ratio),
        exactly((1.0 / 1.5..1.5).contains(&ratio)),
    );
    Ok(Page {
        about: "The square-root CD-CKF with 7 states, 4 noises and 3 measures, run once over a scalar that counts its own \
                operations. As in the paper, the functions of the model (drift, its expansion, radar) are not counted. Flops \
                are additions, multiplications, divisions and roots; comparisons and elementary functions (the wrapping of \
                angles) stand beside them. The counts are of the program as it is, with its tests of pivots and of numbers \
                that are not finite."
            .to_owned(),
        claims: vec![
            Claim::lost(
                "Table V: flops of an update cycle",
                "",
                format!("time update {}, measurement update {}", predict.flops(), joint.flops()),
                "the numbers and formulas of the table are lost in the scan",
            ),
            Claim { published: page, ..same.explained(REMARK) },
        ],
        tables: vec![table],
        figures: vec![("operations", drawn(&[("time", predict), ("joint", joint), ("separate", separate)]))],
        ..Page::default()
    })
}

/// Flops by kind, one bar a step; each kind stands on those before it.
fn drawn(steps: &[(&str, Count)]) -> Figure {
    type Kind = (&'static str, fn(&Count) -> u64);
    const KINDS: [Kind; 4] = [
        ("additions", |count| count.additions),
        ("multiplications", |count| count.multiplications),
        ("divisions", |count| count.divisions),
        ("roots", |count| count.roots),
    ];
    let mut marks = Vec::new();
    for (k, (_, count)) in steps.iter().enumerate() {
        let (x, mut below) = (k as f64 + 1.0, 0.0);
        for ((kind, of), colour) in KINDS.into_iter().zip(COLOURS) {
            let top = below + of(count) as f64;
            let name = if k == 0 { kind } else { "" };
            marks.push(Mark::new(
                name,
                colour,
                Shape::Band { rows: vec![[x - 0.3, below, top], [x + 0.3, below, top]] },
            ));
            below = top;
        }
    }
    let names: Vec<&str> = steps.iter().map(|(name, _)| *name).collect();
    let y = axis("flops", Scale::Linear);
    let panel = Panel { x: crate::drawing::names(&names), y, marks, ..Panel::default() };
    figure(
        "Operations of the square-root CD-CKF: a time step, and a measurement update either way",
        true,
        vec![panel],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_update_costs_no_less_than_its_triangularisation_and_not_many_times_it() {
        // Householder of r rows and c columns: 2 Σ (r − i) (c − i) multiplications and as many additions, or so
        let (predict, joint) = costs(Block::Joint).unwrap();
        let householder =
            |rows: u64, columns: u64| 4 * (0..rows).map(|i| (rows - i) * (columns - i)).sum::<u64>();
        assert!(predict.flops() > householder(7, 14) / 2 && predict.flops() < 6 * householder(7, 22));
        assert!(joint.flops() > 500 && joint.flops() < 6 * householder(10, 17), "{joint:?}");
        assert!(joint.roots >= 7 && predict.roots >= 7);
    }
}
