"""A rigid-body engine by the SPOOK method: worlds to build, and scenes with known answers.

    world = spook.World(friction=0.5)
    world.add_plane()
    box = world.add(x=(0, 0, 1), half_sides=(0.3, 0.2, 0.1))
    world.step(1 / 60, steps=120)
    print(world.x[box])

    run = spook.scene("stack", bodies=10, ratio=1000).run(h="1/60", time=5, solver="direct")
    print(run.error, run.state, run.us_per_step)

Numbers are in SI units, angular velocities in world coordinates, quaternions (w, x, y, z). Invalid input raises a
ValueError that names the parameter and its value. A world whose numbers are not finite raises SimulationDiverged. One
that is finite and wrong warns once, by a RuntimeWarning, and in its state and reason.
"""

from .arguments import explained  # before _spook, which hides that NumPy is missing
from ._spook import SimulationDiverged, PointWorld, World, __version__, scenes, solvers
from .pickled import picklable
from .scene import Run, Scene, scene
from .sweep import Table, sweep

for _kind in (World, PointWorld):
    picklable(explained(_kind))

__all__ = ["SimulationDiverged", "PointWorld", "Run", "Scene", "Table", "World", "__version__", "scene", "scenes", "solvers",
           "sweep"]
