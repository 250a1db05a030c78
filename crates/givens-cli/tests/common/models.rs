//! Small models and tables of the tests.

/// A radar and a position sensor look at a body that moves with constant velocity in the plane.
pub const MODEL: &str = r#"[state]
names = ["x", "vx", "y", "vy"]
time = 0.0
mean = [30, 1, 40, -2]
std = [5, 1, 5, 1]

[parameters]
q = 0.1

[dynamics]
transition = { x = "x + dt*vx", vx = "vx", y = "y + dt*vy", vy = "vy" }
noise_cov = [
    ["q*dt^3/3", "q*dt^2/2", 0, 0],
    ["q*dt^2/2", "q*dt", 0, 0],
    [0, 0, "q*dt^3/3", "q*dt^2/2"],
    [0, 0, "q*dt^2/2", "q*dt"],
]

[[sensor]]
name = "radar"
measures = { range = "hypot(x, y)", bearing = "atan2(y, x)" }
std = { range = 1, bearing = 0.02 }
angles = ["bearing"]

[[sensor]]
name = "gps"
measures = { px = "x", py = "y" }
cov = [[4, 1], [1, 4]]

[plot]
plane = ["x", "y"]

[filter]
method = "sr-ukf"
kappa = 0
"#;

/// Measurements of [`MODEL`]: whole rows, single cells, and one row without any.
pub const DATA: &str = "time,range,bearing,px,py
1,49.5,0.88,,
2,50.2,0.84,32.5,36.5
3,,0.79,,
4,,,,
5,48.7,,35.1,31.2
";

/// True states of [`MODEL`] at some of the rows of [`DATA`].
pub const TRUTH: &str = "time,x,y
1,31,38
2,32,36
5,35,30
";

/// One state that walks at random, measured as it is: all can be computed by hand.
pub const WALK: &str = r#"[state]
names = ["x"]
time = 0
mean = [0]
std = [2]
[dynamics]
transition = ["x"]
noise_cov = [["dt"]]
step = 1
[[sensor]]
name = "level"
measures = { z = "x" }
std = [1]
"#;

/// An oscillator that is damped the more, the farther it is out, and its position.
pub const OSCILLATOR: &str = r#"[state]
names = ["x", "v"]
time = 0
mean = [1, 0]
std = [0.3, 0.3]

[parameters]
mu = 2

[dynamics]
drift = { x = "v", v = "mu*(1 - x^2)*v - x" }
diffusion = { v = "0.2" }

[[sensor]]
name = "eye"
measures = { z = "x" }
std = [0.1]
"#;
