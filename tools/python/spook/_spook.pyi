"""The extension module: worlds of the engine, and scenes in the words of ./course run."""

from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self

Vector = Sequence[float] | NDArray[np.float64]  # of three numbers
Array = NDArray[np.float64]

class SimulationDiverged(RuntimeError):
    """A position or velocity is no longer finite, or a distance has lost its direction."""

class _EitherWorld:
    """What the two have in common."""

    def add_plane(self, n: Vector = (0, 0, 1), offset: float = 0) -> int:
        """Adds the half-space n·x < offset as a static body; |n| = 1."""
    def remove_body(self, body: int) -> None:
        """Removes a body with its joints; the indices of bodies after it go down by one. Raises BufferError while there
        are arrays that look at the bodies."""
    def set_material(self, body: int, other: int | None = None, *, friction: float | None = None,
                     restitution: float | None = None, k: float | None = None, d: float | None = None) -> None:
        """Sets the material of a body where it touches, or of a pair of bodies; what is left out is the world's. For two
        bodies friction is the geometric mean, restitution the larger, k the softer, d the larger."""
    def exclude_contacts(self, bodies: Sequence[int]) -> None:
        """Excludes contacts: no two of these bodies touch from now on. A body may be in several such lists. Without a
        list, bodies on a joint touch as any two bodies do."""
    def add_joint(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., length: float | None = None,
                  k: float | None = None, d: float | None = None) -> int:
        """Joins points p_i, p_j of two bodies, in their axes [m]: a distance if length is given, else a ball joint."""
    def add_rope(self, i: int, j: int, length: float, p_i: Vector = ..., p_j: Vector = ..., k: float | None = None,
                 d: float | None = None) -> int:
        """Adds a largest distance of the points p_i, p_j of two bodies, in their axes [m]: a rope, which pulls where it is
        taut, and does nothing where it is slack."""
    def remove_joint(self, joint: int) -> None:
        """Takes a joint out; the indices of those after it go down by one."""
    def apply_central_impulse(self, body: int, impulse: Vector) -> None:
        """An impulse through the body's centre [N s]."""
    def place(self, body: int, x: Vector | None = None, v: Vector | None = None) -> None:
        """Puts a body that moves somewhere [m], and lets it move [m/s]; what is left out stays as it is."""
    def place_all(self, *, x: Array | None = None, v: Array | None = None) -> None:
        """Puts all bodies that move at the rows of x [m] and gives them those of v [m/s], as place does; a row for each
        body, and rows of static ones are ignored."""
    def save(self) -> Self:
        """Returns a copy, to go back to by restore: bodies, joints, time, the impulses of a warm start."""
    def restore(self, saved: Self) -> None:
        """Goes back to a copy; the next steps are those of the copy, to the last bit. Raises BufferError while there are
        arrays that look at the bodies."""
    def move_fixed(self, body: int, x: Vector) -> None:
        """Puts a fixed body elsewhere [m]."""
    def set_surface_velocity(self, body: int, v: Vector) -> None:
        """Moves the surface of a static body or plane, and not the body, with a velocity [m/s]: a conveyor belt."""
    def start_half_step_back(self, h: float) -> None:
        """Takes the velocities half a step back, under gravity alone; once, before the first step."""
    def start_consistently(self, h: float) -> None:
        """The same, with what contacts and joints hold against; once, before the first step."""
    def synchronized_velocity(self, body: int, h: float) -> Array:
        """The velocity at the time of the position, from the one half a step of h before [m/s]."""
    def step(self, h: float, steps: int = 1) -> None:
        """Moves on by so many steps of h [s], while other threads of Python run. Raises ValueError for h, and
        SimulationDiverged. Warns once (RuntimeWarning) when the world is lost."""
    @property
    def time(self) -> float:
        """[s]"""
    @property
    def steps(self) -> int:
        """Taken so far."""
    @property
    def masses(self) -> Array:
        """Of each body [kg], a copy; infinite for a static one."""
    @property
    def energy(self) -> dict[str, float]:
        """The kinetic energy, of velocities that are half a step behind, and the potential energy of the weight [J]."""
    @property
    def state(self) -> str:
        """The verdict on all steps so far: "sound", "unsolved" (the solver left more than a hundredth of a step) or "lost"
        (what happened has no cause in the problem)."""
    @property
    def reason(self) -> str:
        """Why the state is not "sound"; empty if it is."""
    @property
    def note(self) -> str:
        """What else there is to say: the first spring that gives by more than a hundredth of a size."""
    @property
    def x(self) -> Array:
        """Positions, a row a body [m]. The engine's own numbers, to be read only: they change with each step. While
        such an array is there no body can be added."""
    @property
    def v(self) -> Array:
        """Velocities, half a step before the positions [m/s]; as x."""
    def contacts(self) -> dict[str, NDArray[Any]]:
        """The contacts of the last step, copies: i, j, gap [m], point [m], normal, normal_impulse and impulse [N s], and
        force [N], on j."""
    def joints(self) -> dict[str, Any]:
        """The joints, copies: kind, i, j, and what each did to j in the last step: force [N], and in a World torque [N m].
        A World has position [rad or m] and speed of hinges and sliders, too; NaN for other joints."""
    def joint_impulse(self, joint: int) -> Array:
        """Of each row of a joint in the last step [N s], a copy."""
    def joint_force(self, joint: int) -> Array:
        """What a joint did to body j in the last step [N]."""
    def contact_force(self, contact: int) -> Array:
        """What a contact did to body j in the last step, friction included [N]."""
    def report(self) -> dict[str, Any]:
        """Of the last step: pairs, contacts, impacts, rows, iterations, residual [m/s], trouble."""
    def __len__(self) -> int: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: dict) -> Self: ...

class PointWorld(_EitherWorld):
    """Point masses, by the SPOOK method: as World, without all that turns, and cheaper."""

    def __init__(self, *, gravity: Vector = (0, 0, -9.81), k: float | None = None, d: float | None = None, friction: float = 0,
                 viscosity: float = 1e12, restitution: float | None = None, threshold: float = 1e-9,
                 solver: str = "auto", friction_model: str | None = None, tangents: str = "fixed", iterations: int = 50,
                 tolerance: float = 0, warm_start: bool = False, contact_margin: float | None = None,
                 integrator_order: int = 2, max_parts: int = 32, threads: int = 1, check: bool = True) -> None:
        """Makes an empty world. Raises ValueError for what makes no sense.

        gravity [m/s^2]; k [N/m] and d [steps] of contacts and joints, with a default k that goes with masses and
        forces. friction is the coefficient of friction, and friction_model "cone", "two_pass" or "box" (default: the
        cone where the solver has it, else two_pass); tangents "fixed" or "sliding" are the directions of friction.
        There are impacts only with a restitution, beyond the threshold [m/s]. solver is one of spook.solvers(); it
        stops after so many iterations, or at the tolerance [m/s]. A slightly open contact keeps its row within the
        contact_margin [m]. integrator_order is 2 or 4. max_parts is the largest number of parts of a step, a power of two.
        check looks after each step whether the run is still sound, for state, reason and the warning; this costs about
        as much as a sweep."""
    def add_fixed(self, x: Vector, radius: float = 0) -> int:
        """Adds a static body; a sphere, if it has a radius [m]. Raises BufferError as add."""
    def add(self, *, x: Vector = ..., v: Vector = ..., mass: float = 1, radius: float = 0) -> int:
        """Adds a point mass, with a sphere about it if it has a radius, and returns its index. Raises BufferError
        while there are arrays that look at the bodies."""

    def set_velocity(self, body: int, v: Vector) -> None:
        """Moves a static body from now on with a velocity [m/s]: a kinematic body, which contacts and joints see."""
    def set_velocity_function(self, body: int, v: Callable[[float], Vector]) -> None:
        """Moves a static body from now on with a velocity that depends on time, v(t) [m/s]; a step takes the velocity at
        its middle."""
    def set_keyframes(self, body: int, times: Sequence[float], x: Array) -> None:
        """Moves a static body along keyframes: at each of the times [s] it is at a row of x [m], with a constant velocity
        between them, and stands still before and after. Places it where it is at the present time."""
    def set_force(self, body: int, force: Vector) -> None:
        """On a body from now on, beside its weight [N]; until it is set anew."""

class World(_EitherWorld):
    """Rigid bodies, by the SPOOK method."""

    def __init__(self, *, gravity: Vector = (0, 0, -9.81), k: float | None = None, d: float | None = None, friction: float = 0,
                 viscosity: float = 1e12, restitution: float | None = None, threshold: float = 1e-9,
                 solver: str = "auto", friction_model: str | None = None, tangents: str = "fixed", iterations: int = 50,
                 tolerance: float = 0, warm_start: bool = False, contact_margin: float | None = None,
                 integrator_order: int = 2, max_parts: int = 32, threads: int = 1, check: bool = True,
                 rotation: str = "splitting") -> None:
        """Makes an empty world. Raises ValueError for what makes no sense.

        gravity [m/s^2]; k [N/m] and d [steps] of contacts and joints, with a default k that goes with masses and
        forces. friction is the coefficient of friction, and friction_model "cone", "two_pass" or "box" (default: the
        cone where the solver has it, else two_pass); tangents "fixed" or "sliding" are the directions of friction.
        There are impacts only with a restitution, beyond the threshold [m/s]. solver is one of spook.solvers(); it
        stops after so many iterations, or at the tolerance [m/s]. A slightly open contact keeps its row within the
        contact_margin [m]. integrator_order is 2 or 4, and rotation "splitting", "exponential" or "first_order". max_parts
        is the largest number of parts of a step, a power of two: steps are divided where bodies on joints turn fast or
        carry heavy loads. check looks after each step whether the run is still sound, for state, reason and the
        warning; this costs about as much as a sweep."""
    def add_fixed(self, x: Vector, radius: float = 0, *, q: Sequence[float] = (1, 0, 0, 0), half_length: float = 0,
                  half_sides: Vector = ...) -> int:
        """Adds a static body: a point, a sphere of a radius, a capsule of a radius and a half_length, or a box of
        half_sides [m], turned by q. Raises BufferError as add."""
    def add(self, *, x: Vector = ..., v: Vector = ..., mass: float = 1, radius: float = 0,
            q: Sequence[float] = (1, 0, 0, 0), omega: Vector = ..., principal: Vector | None = None,
            half_length: float = 0, half_sides: Vector = ..., corners: Sequence[Vector] = ()) -> int:
        """Adds a rigid body and returns its index: a sphere of a radius, a capsule of a radius and a half_length along its
        z axis, a box of half_sides, or corners that planes stop [m]. principal are its moments of inertia [kg m²]; spheres,
        capsules and boxes know theirs. Raises BufferError
        while there are arrays that look at the bodies."""
    def set_force(self, body: int, force: Vector = (0, 0, 0), torque: Vector = (0, 0, 0)) -> None:
        """At its centre from now on, beside its weight [N, N m], in world coordinates; until it is set anew."""
    def set_velocity(self, body: int, v: Vector, omega: Vector = (0, 0, 0)) -> None:
        """Moves a static body from now on with a velocity [m/s], and turns it with an angular velocity [rad/s]: a kinematic
        body, such as a platform, which contacts, friction and joints see."""
    def set_velocity_function(self, body: int, v: Callable[[float], Vector],
                              omega: Callable[[float], Vector] | None = None) -> None:
        """Moves a static body from now on with velocities that depend on time, v(t) [m/s] and omega(t) [rad/s]; a step
        takes the velocities at its middle."""
    def set_keyframes(self, body: int, times: Sequence[float], x: Array, q: Array | None = None) -> None:
        """Moves a static body along keyframes: at each of the times [s] it is at a row of x [m], and turned as a row of q
        says (w, x, y, z). Between them its velocity is constant, and it turns about one axis, by the shorter way. Before
        and after it stands still. Places it where it is at the present time."""
    def turn(self, body: int, q: Sequence[float] | None = None, omega: Vector | None = None) -> None:
        """Gives a body that moves an orientation, and lets it turn [rad/s]; what is left out stays as it is."""
    def turn_all(self, *, q: Array | None = None, omega: Array | None = None) -> None:
        """Gives all bodies that move the orientations of q and the angular velocities of omega [rad/s], as turn does; a row
        for each body, and rows of static ones are ignored."""
    def synchronized_angular_velocity(self, body: int, h: float) -> Array:
        """The angular velocity at the time of the position, as synchronized_velocity."""
    def add_hinge(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., axis: Vector = (0, 0, 1),
                  limits: Sequence[float] | None = None, motor: Sequence[float] | None = None,
                  k: float | None = None, d: float | None = None, k_turn: float | None = None,
                  spring: Sequence[float] | None = None) -> int:
        """Points p_i, p_j of two bodies, in their axes [m], together, and free to turn about an axis of i's. The angle is
        0 as they are now. limits: from, to [rad]; motor: its speed [rad/s] and its largest torque [N m]; k_turn: stiffness
        of what must not turn [N m/rad]; spring: its stiffness [N m/rad], its damping [N m s/rad] and the angle at which it is
        relaxed [rad], 0 where left out."""
    def add_slider(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., axis: Vector = (0, 0, 1),
                   limits: Sequence[float] | None = None, motor: Sequence[float] | None = None,
                   k: float | None = None, d: float | None = None, k_turn: float | None = None,
                   spring: Sequence[float] | None = None) -> int:
        """Free to slide along an axis of i's, and not to turn. limits [m]; motor: its speed [m/s], its largest force [N];
        spring: its stiffness [N/m], its damping [N s/m] and the shift at which it is relaxed [m], 0 where left out."""
    def add_weld(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., k: float | None = None,
                 d: float | None = None, k_turn: float | None = None) -> int:
        """Points of two bodies together, and neither turns from how it is now."""
    def set_motor(self, joint: int, motor: Sequence[float] | None) -> None:
        """Drives a hinge or slider otherwise from now on, or with None no longer."""
    def set_spring(self, joint: int, spring: Sequence[float] | None) -> None:
        """Replaces the spring of a hinge or slider, or with None removes it: stiffness, damping, rest."""
    def joint_position(self, joint: int) -> float:
        """The angle of a hinge, its turns counted [rad], or the shift of a slider [m]."""
    def joint_speed(self, joint: int) -> float:
        """How fast it changes, half a step before [rad/s, m/s]."""
    def joint_torque(self, joint: int) -> Array:
        """Beside its force, the torque of a joint on body j in the last step [N m]."""
    def motor_force(self, joint: int) -> float:
        """What its motor did to body j in the last step, along what is free [N m, N]."""
    def limit_force(self, joint: int) -> float:
        """The same of its limit."""
    def spring_force(self, joint: int) -> float:
        """The same of its spring and damper."""
    @property
    def omega(self) -> Array:
        """Angular velocities, in world coordinates [rad/s]; as x."""
    @property
    def q(self) -> Array:
        """Orientations (w, x, y, z), body to world. A copy: the engine keeps its quaternions in another order."""

__version__: str

def scenes() -> list[str]:
    """Their names."""

def solvers() -> list[str]:
    """Their names."""

def describe(scene: str) -> dict[str, Any]: ...
def check(scene: str, parameters: dict[str, str], options: dict[str, str]) -> None: ...
def run(scene: str, parameters: dict[str, str], options: dict[str, str]) -> dict[str, Any]: ...
def record(scene: str, parameters: dict[str, str], options: dict[str, str], fps: float) -> bytes: ...
