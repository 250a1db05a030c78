//! W5: Lorenz-96, one step of the classic Runge–Kutta method, or as it is, in continuous time; every other component is measured.

use givens_core::model::{At, Noise, Observation, Sde, Transition, Varies};
use givens_core::scalar::Real;

/// With this many states.
pub struct Circle(pub usize);

/// More than any workload has.
const MOST: usize = if cfg!(feature = "scaling") { 1000 } else { 256 };

#[inline(always)]
fn drift<T: Real>(x: &[T], dx: &mut [T]) {
    let (n, forcing) = (x.len(), T::of(8.0));
    if n < 4 {
        for (i, dx) in dx.iter_mut().enumerate() {
            *dx = (x[(i + 1) % n] - x[(i + n - 2) % n]) * x[(i + n - 1) % n] - x[i] + forcing;
        }
        return;
    }
    dx[0] = (x[1] - x[n - 2]) * x[n - 1] - x[0] + forcing;
    dx[1] = (x[2] - x[n - 1]) * x[0] - x[1] + forcing;
    dx[n - 1] = (x[0] - x[n - 3]) * x[n - 2] - x[n - 1] + forcing;
    for (dx, x) in dx[2..n - 1].iter_mut().zip(x.windows(4)) {
        *dx = (x[3] - x[0]) * x[1] - x[2] + forcing;
    }
}

/// One step of the classic method, of at most N states.
#[inline(always)]
fn classic<T: Real, const N: usize>(at: &At<T>, x: &[T], out: &mut [T]) {
    let n = x.len();
    let (mut k, mut y) = ([T::zero(); N], [T::zero(); N]);
    let (k, y) = (&mut k[..n], &mut y[..n]);
    out.copy_from_slice(x);
    y.copy_from_slice(x);
    for (weight, ahead) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
        let (weight, ahead) = (T::of(weight / 6.0) * at.dt, T::of(ahead) * at.dt);
        drift(y, k);
        for i in 0..n {
            out[i] = weight.mul_add(k[i], out[i]);
            y[i] = ahead.mul_add(k[i], x[i]);
        }
    }
}

impl Transition for Circle {
    fn states(&self) -> usize {
        self.0
    }

    #[inline(always)]
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        // memory of about the right size: to clear more would take longer than the step
        match x.len() {
            ..=32 => classic::<T, 32>(at, x, out),
            33..=64 => classic::<T, 64>(at, x, out),
            65..=128 => classic::<T, 128>(at, x, out),
            129..=256 => classic::<T, 256>(at, x, out),
            _ => classic::<T, MOST>(at, x, out),
        }
    }

    fn noise(&self) -> Noise {
        Noise::Root(self.0)
    }

    #[inline(always)]
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        diagonal(self.0, 0.05_f64.sqrt(), out);
    }
}

impl Sde for Circle {
    fn states(&self) -> usize {
        self.0
    }

    fn noises(&self) -> usize {
        self.0
    }

    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        drift(x, dx);
    }

    #[inline(always)]
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        diagonal(self.0, 1.0, g);
    }

    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// It, seen.
pub struct Every(pub usize);

impl Observation for Every {
    fn states(&self) -> usize {
        self.0
    }

    fn measures(&self) -> usize {
        self.0 / 2
    }

    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z.iter_mut().zip(x.iter().step_by(2)).for_each(|(z, &x)| *z = x);
    }

    fn noise(&self) -> Noise {
        Noise::Root(self.0 / 2)
    }

    #[inline(always)]
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        diagonal(self.0 / 2, 1.0, out);
    }
}

#[inline(always)]
fn diagonal<T: Real>(n: usize, value: f64, out: &mut [T]) {
    out.fill(T::zero());
    out.iter_mut().step_by(n + 1).for_each(|out| *out = T::of(value));
}
