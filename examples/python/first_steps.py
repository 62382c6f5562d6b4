# A script in cells: run it whole, or cell by cell in Spyder, VS Code or Jupyter (jupytext).

# %% A model as a dict: the keys are those of a model file (edda keys lists them).
import edda
import matplotlib.pyplot as plt
import numpy as np

model = edda.load(
    {
        "title": "Three blocks on a slope",
        "materials": {"rock": {"density": 2500, "young": "5 GPa", "poisson": 0.25}},
        "joints": {"face": {"friction_angle": 25}},
        "contact": {"normal_stiffness": "5 GPa", "joint": "face"},
        "block": [
            {"name": "slope", "polygon": [[0, 0], [12, 0], [0, 6]], "fixed": True},
            *[
                {"name": f"slab {k}", "polygon": [[2 + 2 * k, 5 - k], [4 + 2 * k, 4 - k], [4 + 2 * k, 6 - k], [2 + 2 * k, 7 - k]]}
                for k in range(3)
            ],
        ],
        "solver": {"duration": 0.6},
    }
)
print(model, model.joints)

# %% Cut it, and look at it before anything moves.
edda.plot_blocks(model.cut(), "area")

# %% Step through it, and watch.
simulation = edda.Simulation(model)
times, speeds = [], []


def watch(simulation):
    times.append(simulation.time)
    speeds.append(np.hypot(*simulation.field("velocity").T))


simulation.every(50, watch)
print(simulation.run())

# %% What the slabs did.
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
edda.plot_blocks(simulation, "displacement", ax=left)
right.plot(times, np.array(speeds)[:, 1:], label=[simulation.name(k) for k in (1, 2, 3)])
right.set_xlabel("time (s)")
right.set_ylabel("speed (m/s)")
right.legend()

# %% The forces between them.
contacts = simulation.contacts()
closed = contacts[contacts["state"] != 0]
print(closed[["block_i", "block_j", "normal_force", "shear_force"]])
plt.show()
