# %% [markdown]
# From a scene to a work-precision figure. `./course python tools/python/examples/work_precision.py` runs it; an editor
# or a notebook runs it cell by cell.

# %%
import matplotlib.pyplot as plt
import spook

scene = spook.scene("stack", bodies=10, ratio=1000)
print(scene.about["answer"])

# %% A run reports its error, and if it is reliable. In a notebook it shows its film.
run = scene.run(h="1/60", time=5, solver="direct")
print(run)

# %% Sweeps against factors: one table.
table = spook.sweep(scene, solver=["gauss_seidel", "direct"], iterations=[10, 100, 1000], time=5, jobs=1)
print(table)

# %% Observed order: the orbit's error against the step.
orbit = spook.sweep(spook.scene("orbit"), start=["half_step", "unshifted"], h=["1/60", "1/120", "1/240"], jobs=1)
print(orbit)

# %%
figure, axes = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
for solver in ("gauss_seidel", "direct"):
    axes[0].loglog(*(table.where(solver=solver)[name] for name in ("seconds", "error")), "o-", label=solver)
for start in ("half_step", "unshifted"):
    axes[1].loglog(*(orbit.where(start=start)[name] for name in ("seconds", "error")), "o-", label=start)
for ax, each in zip(axes, (scene, spook.scene("orbit"))):
    ax.set(title=each.name, xlabel="time to compute [s]", ylabel=f"error [{each.about['error_unit']}]")
    ax.legend()
figure.savefig("work_precision.png")
