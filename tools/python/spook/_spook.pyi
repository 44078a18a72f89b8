"""The extension module: worlds of the engine, and scenes with the options of ./course run."""

from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self

Vector = Sequence[float] | NDArray[np.float64]  # of three numbers
Array = NDArray[np.float64]

class SimulationDiverged(RuntimeError):
    """A position or velocity is no longer finite, or a distance has lost its direction."""

class _EitherWorld:
    """The common functions of both worlds."""

    def add_plane(self, n: Vector = (0, 0, 1), offset: float = 0) -> int:
        """Adds the half-space n·x < offset as a static body; |n| = 1."""
    def remove_body(self, body: int) -> None:
        """Removes a body with its joints; the indices of bodies after it decrease by one. Raises BufferError while
        arrays of the bodies' numbers exist."""
    def set_material(self, body: int, other: int | None = None, *, friction: float | None = None,
                     restitution: float | None = None, k: float | None = None, d: float | None = None,
                     rolling_resistance: float | None = None, torsional_resistance: float | None = None) -> None:
        """Sets the material of a body in its contacts, or of a pair of bodies. Default of each value: the world's,
        also of those that an earlier call has set. For two bodies friction is the geometric mean, which is 0 if
        either is 0. Restitution is the larger, k the smaller, d the larger. rolling_resistance and
        torsional_resistance are the largest torques that resist rolling, and spinning about the normal, over the
        normal force [m]; default: 0, and the larger for two bodies. A ball of radius r with rolling_resistance ρ rests
        on slopes up to tan θ = ρ/r."""
    def exclude_contacts(self, bodies: Sequence[int]) -> None:
        """Excludes contacts: these bodies do not touch each other from now on. A body may be in several such lists.
        Without a list, bodies on a joint touch as any two bodies do."""
    def add_joint(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., length: float | None = None,
                  k: float | None = None, d: float | None = None) -> int:
        """Joins points p_i, p_j of two bodies, in their axes [m]: a distance if length is given, else a ball joint."""
    def add_rope(self, i: int, j: int, length: float, p_i: Vector = ..., p_j: Vector = ..., k: float | None = None,
                 d: float | None = None) -> int:
        """Adds a rope: a largest distance of the points p_i, p_j of two bodies, in their axes [m]. It pulls while it is
        taut, and does nothing while it is slack."""
    def remove_joint(self, joint: int) -> None:
        """Removes a joint; the indices of those after it decrease by one."""
    def apply_central_impulse(self, body: int, impulse: Vector) -> None:
        """Applies an impulse at the body's centre [N s]."""
    def place(self, body: int, x: Vector | None = None, v: Vector | None = None) -> None:
        """Sets the position [m] and the velocity [m/s] of a dynamic body. Default of each: unchanged."""
    def place_all(self, *, x: Array | None = None, v: Array | None = None) -> None:
        """Sets the positions of all dynamic bodies to the rows of x [m] and their velocities to those of v [m/s], as
        place does. Each body has a row; rows of static bodies are ignored."""
    def save(self) -> Self:
        """Returns a copy of the bodies, joints, time, and impulses of a warm start, for restore."""
    def restore(self, saved: Self) -> None:
        """Restores a copy; the next steps are those of the copy, to the last bit. Raises BufferError while arrays of
        the bodies' numbers exist."""
    def get_state(self) -> bytes:
        """Returns all that steps change, as bytes: for a file, or for another process."""
    def set_state(self, state: bytes) -> None:
        """Continues from the bytes of get_state; the next steps have the same bits. This world must have been built as
        that one was, by the same build of the module. Raises ValueError for the bytes of another world."""
    def move_fixed(self, body: int, x: Vector) -> None:
        """Moves a static body to another position [m]."""
    def set_surface_velocity(self, body: int, v: Vector) -> None:
        """Sets a velocity of the surface of a static body or plane, which itself does not move [m/s]: a conveyor
        belt. The velocity of a plane has no part along its normal."""
    def start_half_step_back(self, h: float) -> None:
        """Sets the velocities back by half a step, under gravity alone. May be called once, before the first step."""
    def start_consistently(self, h: float) -> None:
        """Sets the velocities back by half a step, under gravity and the forces of contacts and joints: then positions
        have errors of order h^2, and without this call of order h. May be called once, before the first step."""
    def synchronized_velocity(self, body: int, h: float) -> Array:
        """Returns the velocity at the time of the position, from the stored one, velocity_lag(h) before [m/s]. If a
        contact acts on the body, it is the stored one."""
    def velocity_lag(self, h: float) -> float:
        """Returns the time from velocities to positions after a step of h [s]: h/(2 parts), and 0 for an
        integrator_order of 4."""
    def step(self, h: float, steps: int = 1) -> None:
        """Advances by so many steps of h [s], while other threads of Python run. Raises ValueError for h, and
        SimulationDiverged. Warns once (RuntimeWarning) when the world is lost. A step that another exception ends, such
        as one of a velocity function, does not count in steps, but may have moved bodies."""
    @property
    def time(self) -> float:
        """The time [s]."""
    @property
    def steps(self) -> int:
        """The number of steps so far."""
    @property
    def parts(self) -> int:
        """The number of equal parts of the last step, at most max_parts. Contacts, rows, forces and impulses are those
        of its last part."""
    @property
    def work_of_drives(self) -> float:
        """The work of all motors, springs and kinematic bodies in the last step, that of impacts left out [J]."""
    @property
    def masses(self) -> Array:
        """The mass of each body [kg], as a copy; infinite for a static one."""
    @property
    def energy(self) -> dict[str, float]:
        """The kinetic energy, from velocities velocity_lag(h) behind, the potential energy of gravity, and the energy of
        springs under the forces of the last step: of contacts, of joints, and on hinges and sliders [J]."""
    @property
    def state(self) -> str:
        """The verdict on all steps so far: "sound", "unsolved" (the solver's error in a step exceeds a hundredth of the
        right-hand side, or its iterations do not converge) or "lost" (the motion is not that of the problem). A world
        with check=False is "unchecked"."""
    @property
    def reason(self) -> str:
        """The reason why the state is not "sound"; empty if it is."""
    @property
    def note(self) -> str:
        """Further notes, each of these when it is first found: a spring that yields by more than a hundredth of a body's
        size; a body that passes another within a step; joints that take out energy; a world in which nothing can
        move."""
    @property
    def x(self) -> Array:
        """Positions, a row for each body [m]. The array is the engine's own and read-only: its numbers change with each
        step. While such an array exists no body can be added."""
    @property
    def v(self) -> Array:
        """Velocities, velocity_lag(h) before the positions [m/s]; read-only as x."""
    def contacts(self) -> dict[str, NDArray[Any]]:
        """Copies of the contacts of the last step: i, j, gap [m], point [m], normal, normal_impulse and impulse [N s],
        and force [N], on j. Either body may have the smaller index."""
    def impacts(self) -> dict[str, NDArray[Any]]:
        """Copies of the impacts of the last step, collisions with restitution: i, j, and the speed [m/s] of the approach
        along the normal. Afterwards the contact may be open again, and then contacts() does not have it."""
    def joints(self) -> dict[str, Any]:
        """Copies of the joints: kind, i, j, and the force on j in the last step [N]. A World adds the torque [N m], and
        position [rad or m] and speed of hinges and sliders; NaN for other joints."""
    def joint_impulse(self, joint: int) -> Array:
        """Returns the impulse of each row of a joint in the last step [N s], as a copy."""
    def joint_force(self, joint: int) -> Array:
        """Returns the force of a joint on body j [N], at the beginning of the last step, or of its last part. With
        integrator_order 4 it belongs to the middle of the step."""
    def contact_force(self, contact: int) -> Array:
        """Returns the force of a contact on body j, including friction [N], at the beginning of the last step."""
    def cast_ray(self, origin: Vector, direction: Vector, longest: float = ...) -> dict[str, Any] | None:
        """Returns the first body that a ray enters: body, point [m], outward normal and distance [m]; None if there is
        none within longest [m]. Default: any distance. The direction may have any length above 0. A body that contains
        the origin is not hit, nor one that the ray only touches, nor one of corners."""
    def overlapping(self, centre: Vector, radius: float) -> list[int]:
        """Returns the bodies with a point within a radius [m] of the centre. With a radius of 0 these are the bodies
        that contain the point. Bodies of corners, and points, are left out."""
    def report(self) -> dict[str, Any]:
        """Numbers of the last step: pairs, contacts, impacts, rows, iterations, residual [m/s], trouble."""
    def __len__(self) -> int: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: dict) -> Self: ...

class PointWorld(_EitherWorld):
    """Point masses, by the SPOOK method: a World without rotations, at less cost."""

    def __init__(self, *, gravity: Vector = (0, 0, -9.81), k: float | None = None, d: float | None = None, friction: float = 0,
                 viscosity: float = 1e12, restitution: float | None = None, threshold: float = 1e-9,
                 solver: str = "auto", friction_model: str | None = None, tangents: str = "fixed", iterations: int = 50,
                 tolerance: float = 0, warm_start: bool = False, contact_margin: float | None = None,
                 integrator_order: int = 2, max_parts: int = 32, soft_steps: int | None = None,
                 accuracy: float | None = None, threads: int = 1, check: bool = True) -> None:
        """Makes an empty world. Raises ValueError for invalid input.

        gravity [m/s^2]; stiffness k [N/m] and relaxation d [steps] of contacts and joints. Default of k: by masses and
        forces. friction is the coefficient of friction, and friction_model "cone", "two_pass" or "box". Default: the
        cone if the solver has it, else two_pass: direct, conjugate_gradients and spatial_decomposition have no cone.
        two_pass and box limit the friction along two tangents each, and so resist oblique motion up to sqrt(2) times too
        much. tangents "fixed" or "sliding" are these directions.
        There are impacts only with a restitution, of the world or of a material, at approach speeds above the
        threshold [m/s], which needs a restitution of the world. solver is one
        of spook.solvers(); it stops after so many iterations, or at the tolerance [m/s]. A slightly open
        contact keeps its row within the contact_margin [m]. warm_start starts sweeps with the last impulses, and has no
        effect on direct and newton. integrator_order is 2 or 4. max_parts is the
        largest number of parts of a step, a power of two. soft_steps is a number of substeps: the method of
        game engines, fast and accurate to a per cent or so. It has no k and d, and sweeps of its own, so solver,
        friction_model, iterations, tolerance, warm_start and max_parts are refused, too. accuracy is the share of
        the right-hand side that a solve by "auto" may leave. Default: 1e-6, and 3e-3 of the fastest approach while
        bodies move. check tests after each step that the run is sound, for state, reason and the warning; this
        costs about as much as a sweep."""
    def add_fixed(self, x: Vector, radius: float = 0) -> int:
        """Adds a static body: a sphere, if it has a radius [m], else a point. Raises BufferError as add."""
    def add(self, *, x: Vector = ..., v: Vector = ..., mass: float = 1, radius: float = 0) -> int:
        """Adds a point mass, as a sphere if it has a radius, and returns its index. Raises BufferError while arrays of
        the bodies' numbers exist."""

    def set_velocity(self, body: int, v: Vector) -> None:
        """Makes a static body kinematic: it moves with this velocity from now on [m/s], which acts in contacts and
        joints."""
    def set_velocity_function(self, body: int, v: Callable[[float], Vector]) -> None:
        """Makes a static body kinematic: from now on it moves with a velocity that depends on time, v(t) [m/s]. A step
        uses the velocity at its middle."""
    def set_keyframes(self, body: int, times: Sequence[float], x: Array) -> None:
        """Makes a static body kinematic, along keyframes. At each of the times [s] it is at a row of x [m], with a
        constant velocity between them; before and after it is at rest. Its position is set to that at the present time.
        """
    def set_force(self, body: int, force: Vector) -> None:
        """Sets a force on a body, in addition to its weight [N], until the next call."""

class World(_EitherWorld):
    """Rigid bodies, by the SPOOK method."""

    def __init__(self, *, gravity: Vector = (0, 0, -9.81), k: float | None = None, d: float | None = None, friction: float = 0,
                 viscosity: float = 1e12, restitution: float | None = None, threshold: float = 1e-9,
                 solver: str = "auto", friction_model: str | None = None, tangents: str = "fixed", iterations: int = 50,
                 tolerance: float = 0, warm_start: bool = False, contact_margin: float | None = None,
                 integrator_order: int = 2, max_parts: int = 32, soft_steps: int | None = None,
                 accuracy: float | None = None, threads: int = 1, check: bool = True, rotation: str = "splitting") -> None:
        """Makes an empty world. Raises ValueError for invalid input.

        gravity [m/s^2]; stiffness k [N/m] and relaxation d [steps] of contacts and joints. Default of k: by masses and
        forces. friction is the coefficient of friction, and friction_model "cone", "two_pass" or "box". Default: the
        cone if the solver has it, else two_pass: direct, conjugate_gradients and spatial_decomposition have no cone.
        two_pass and box limit the friction along two tangents each, and so resist oblique motion up to sqrt(2) times too
        much. tangents "fixed" or "sliding" are these directions.
        There are impacts only with a restitution, of the world or of a material, at approach speeds above the
        threshold [m/s], which needs a restitution of the world. solver is one
        of spook.solvers(); it stops after so many iterations, or at the tolerance [m/s]. A slightly open
        contact keeps its row within the contact_margin [m]. warm_start starts sweeps with the last impulses, and has no
        effect on direct and newton. integrator_order is 2 or 4, and rotation
        "splitting", "exponential" or "first_order". max_parts is the largest number of parts of a step, a power
        of two: steps are divided if bodies on joints rotate fast or carry heavy loads. soft_steps is a number of
        substeps: the method of game engines, fast and accurate to a per cent or so. It has no k and d, and sweeps
        of its own, so solver, friction_model, iterations, tolerance, warm_start and max_parts are refused, too.
        accuracy is the share of the right-hand side that a solve by "auto" may leave. Default: 1e-6, and 3e-3 of
        the fastest approach while bodies move. check tests after each step that the run is sound, for state,
        reason and the warning; this costs about as much as a sweep."""
    def add_fixed(self, x: Vector, radius: float = 0, *, q: Sequence[float] = (1, 0, 0, 0), half_length: float = 0,
                  half_sides: Vector = ...) -> int:
        """Adds a static body: a point, a sphere of a radius, a capsule of a radius and a half_length, or a box of
        half_sides [m], turned by q. Raises BufferError as add."""
    def add(self, *, x: Vector = ..., v: Vector = ..., mass: float = 1, radius: float = 0,
            q: Sequence[float] = (1, 0, 0, 0), omega: Vector = ..., principal: Vector | None = None,
            half_length: float = 0, half_sides: Vector = ..., corners: Sequence[Vector] = ()) -> int:
        """Adds a rigid body and returns its index: a sphere of a radius, a capsule of a radius and a half_length along
        its z axis, a box of half_sides, or corners that touch planes [m]. principal are its moments of inertia [kg m²].
        Default: those of the sphere, capsule or box. Raises BufferError while arrays of the bodies' numbers exist."""
    def set_force(self, body: int, force: Vector = (0, 0, 0), torque: Vector = (0, 0, 0)) -> None:
        """Sets a force and a torque at a body's centre, in addition to its weight [N, N m], in world coordinates, until
        the next call."""
    def set_velocity(self, body: int, v: Vector, omega: Vector = (0, 0, 0)) -> None:
        """Makes a static body kinematic, such as a platform: it moves with a velocity [m/s] and an angular velocity
        [rad/s] from now on. Contacts, friction and joints use these."""
    def set_velocity_function(self, body: int, v: Callable[[float], Vector],
                              omega: Callable[[float], Vector] | None = None) -> None:
        """Makes a static body kinematic: from now on it moves with velocities that depend on time, v(t) [m/s] and
        omega(t) [rad/s]. A step uses the velocities at its middle. The functions cannot use the world: for a feedback
        law call set_velocity between steps."""
    def set_keyframes(self, body: int, times: Sequence[float], x: Array, q: Array | None = None) -> None:
        """Makes a static body kinematic, along keyframes. At each of the times [s] its position is a row of x [m], and
        its orientation a row of q (w, x, y, z). Between them its velocity is constant, and it turns about one axis, by
        the shorter way. Before and after it is at rest. Its position is set to that at the present time."""
    def turn(self, body: int, q: Sequence[float] | None = None, omega: Vector | None = None) -> None:
        """Sets the orientation and the angular velocity [rad/s] of a dynamic body. Default of each: unchanged."""
    def turn_all(self, *, q: Array | None = None, omega: Array | None = None) -> None:
        """Sets the orientations of all dynamic bodies to the rows of q and their angular velocities to those of omega
        [rad/s], as turn does. Each body has a row; rows of static bodies are ignored."""
    def synchronized_angular_velocity(self, body: int, h: float) -> Array:
        """Returns the angular velocity at the time of the position, as synchronized_velocity does."""
    def add_hinge(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., axis: Vector = (0, 0, 1),
                  limits: Sequence[float] | None = None, motor: Sequence[float] | None = None,
                  k: float | None = None, d: float | None = None, k_turn: float | None = None,
                  spring: Sequence[float] | None = None) -> int:
        """Adds a hinge, which joins points p_i, p_j of two bodies, in their axes [m], and is free to turn about an axis
        of i's. The present angle is 0. limits: from, to [rad]; motor: its speed [rad/s] and its largest torque [N m];
        k_turn: the stiffness against other rotations [N m/rad]; spring: its stiffness [N m/rad], its damping [N m
        s/rad] and its rest angle [rad]. Default of the last two: 0."""
    def add_slider(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., axis: Vector = (0, 0, 1),
                   limits: Sequence[float] | None = None, motor: Sequence[float] | None = None,
                   k: float | None = None, d: float | None = None, k_turn: float | None = None,
                   spring: Sequence[float] | None = None) -> int:
        """Adds a slider, which is free to slide along an axis of i's, and not to turn. limits [m]; motor: its speed
        [m/s], its largest force [N]; spring: its stiffness [N/m], its damping [N s/m] and its rest shift [m]. Default
        of the last two: 0."""
    def add_weld(self, i: int, j: int, p_i: Vector = ..., p_j: Vector = ..., k: float | None = None,
                 d: float | None = None, k_turn: float | None = None) -> int:
        """Adds a weld, which joins points of two bodies and keeps their present relative orientation."""
    def set_motor(self, joint: int, motor: Sequence[float] | None) -> None:
        """Replaces the motor of a hinge or slider, or with None removes it."""
    def set_spring(self, joint: int, spring: Sequence[float] | None) -> None:
        """Replaces the spring of a hinge or slider, or with None removes it: stiffness, damping, rest."""
    def joint_position(self, joint: int) -> float:
        """Returns the angle of a hinge, including its turns [rad], or the shift of a slider [m]."""
    def joint_speed(self, joint: int) -> float:
        """Returns the rate of the angle or shift, velocity_lag(h) before the position [rad/s, m/s]."""
    def joint_torque(self, joint: int) -> Array:
        """Returns the torque of a joint on body j in the last step, in addition to its force [N m]."""
    def motor_force(self, joint: int) -> float:
        """Returns the torque or force of the motor on body j in the last step, along the free axis [N m, N]. If the motor
        drives into the joint's limit, this is its strength, and limit_force has the rest."""
    def limit_force(self, joint: int) -> float:
        """Returns the torque or force of the limit on body j in the last step, along the free axis [N m, N]."""
    def spring_force(self, joint: int) -> float:
        """Returns the torque or force of spring and damper on body j in the last step, along the free axis [N m, N]."""
    @property
    def omega(self) -> Array:
        """Angular velocities, in world coordinates [rad/s]; read-only as x."""
    @property
    def q(self) -> Array:
        """Orientations (w, x, y, z), body to world, as a copy: the engine stores its quaternions in another order."""

__version__: str

def scenes() -> list[str]:
    """Returns the names of the scenes."""

def solvers() -> list[str]:
    """Returns the names of the solvers."""

def describe(scene: str) -> dict[str, Any]: ...
def check(scene: str, parameters: dict[str, str], options: dict[str, str]) -> None: ...
def run(scene: str, parameters: dict[str, str], options: dict[str, str]) -> dict[str, Any]: ...
def record(scene: str, parameters: dict[str, str], options: dict[str, str], fps: float) -> bytes: ...
