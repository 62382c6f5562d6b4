"""Pictures: outlines, colours, ranges and labels."""
import edda
import numpy as np
import pytest

plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(autouse=True)
def no_figures_left():
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def tunnel(models, tmp_path_factory):
    """A run with blocks that are not convex, and no block held."""
    path = tmp_path_factory.mktemp("pictures") / "tunnel"
    simulation = edda.Simulation(edda.load(models / "tunnel.toml", ["output.every=0.5"]), results=path)
    simulation.step(300)
    simulation.finish()
    return edda.Results(path), simulation


@pytest.fixture(scope="module")
def slope(models, tmp_path_factory):
    """A run with blocks that are held."""
    path = tmp_path_factory.mktemp("pictures") / "slope"
    simulation = edda.Simulation(edda.load(models / "slope.toml"), results=path)
    simulation.step(500)
    simulation.finish()
    return edda.Results(path), simulation


def drawn(*given, **options):
    return edda.plot_blocks(*given, **options).collections[0]


def rings_of(path):
    return sorted(sorted(map(tuple, ring[:-1].round(9))) for ring in path.to_polygons(closed_only=False))


def area_of(path):
    total = 0.0
    for ring in path.to_polygons(closed_only=False):
        x, y = ring.T
        total += 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
    return total


def test_a_block_of_several_cells_has_one_outline(tunnel):
    results, simulation = tunnel
    frame = results.frames[-1]
    assert len(frame.cells) == len(frame["id"]) == len(np.unique(frame["id"])) == len(frame.polygons())
    paths, values = drawn(frame, "displacement.y").get_paths(), drawn(frame, "displacement.y").get_array()
    alive = np.flatnonzero(simulation.alive)
    assert len(paths) == len(values) == len(alive)
    assert np.array_equal(np.unique(frame["id"]), alive)
    now = drawn(simulation, "displacement.y")
    for path, other in zip(paths, now.get_paths()):
        assert rings_of(path) == rings_of(other)
    assert np.array_equal(values, now.get_array())
    assert [area_of(p) for p in paths] == pytest.approx(results.blocks["area"])


def test_axes_that_are_drawn_in_again_keep_one_colour_bar(tunnel):
    results, simulation = tunnel
    ax = edda.plot_blocks(simulation, "displacement")
    for field in ("velocity", "stress.yy", "displacement", "rotation"):
        place = ax.get_position().bounds
        ax.clear()
        assert edda.plot_blocks(simulation, field, ax) is ax
        assert len(ax.figure.axes) == 2
        assert ax.get_position().bounds == pytest.approx(place), "nothing is taken off it again"
    assert ax.figure.axes[1].get_ylabel() == "rotation (rad)"
    edda.plot_blocks(results, "displacement", ax)
    assert len(ax.figure.axes) == 2
    figure, both = plt.subplots(1, 2)
    for one in both:
        edda.plot_blocks(simulation, "displacement", one)
    assert len(figure.axes) == 4
    ax.figure.axes[1].remove()
    edda.plot_blocks(simulation, "displacement", ax)
    assert len(ax.figure.axes) == 2, "one that was taken away comes back"


RING = {
    "gravity": [0, 0],
    "materials": {"rock": {"density": 2500, "young": 10e9, "poisson": 0.2}},
    "joints": {"j": {"friction_angle": 30}},
    "contact": {"joint": "j"},
    "domain": {"outline": [[0, 0], [4, 0], [4, 4], [0, 4]]},
    "opening": [{"name": "hole", "polygon": [[1, 1], [3, 1], [3, 3], [1, 3]]}],
    "solver": {"duration": 0.001},
}


def test_the_outline_of_a_block_with_a_hole_has_the_hole(tmp_path):
    edda.run(RING, tmp_path / "out")
    frame = edda.Results(tmp_path / "out").frames[-1]
    assert len(frame.cells) == 1 and [len(rings) for rings in frame.rings()] == [2]
    assert len(frame.polygons()[0]) == 4 and np.ptp(frame.polygons()[0]) == pytest.approx(4), "the outer ring"
    (path,) = drawn(frame).get_paths()
    assert sorted(len(ring) for ring in rings_of(path)) == [4, 4]
    assert area_of(path) == pytest.approx(12.0)  # the hole runs the other way round


def test_held_blocks_do_not_count_for_the_colours(slope):
    results, simulation = slope
    free = simulation.fixed == 0
    assert 0 < np.count_nonzero(~free)
    size = np.hypot(*simulation.field("displacement").T)
    for source in (results, results.frames[-1], simulation):
        for options in ({}, {"whole_range": True}):
            colours = drawn(source, "displacement", **options)
            assert colours.get_clim() == (size[free].min(), size[free].max())
            assert colours.axes.figure.axes[-1]._colorbar.extend == "neither"
            colours.update_scalarmappable()
            assert np.all(colours.get_facecolors()[~free] == (0.8, 0.8, 0.8, 1.0))
            assert not np.any(np.all(colours.get_facecolors()[free] == (0.8, 0.8, 0.8, 1.0), axis=1))
    assert drawn(simulation, "displacement", clim=(0.0, 1.0)).get_clim() == (0.0, 1.0)
    by_array = drawn(simulation, np.where(free, 2.0, 0.0) + size)
    assert by_array.get_clim() == ((2.0 + size)[free].min(), (2.0 + size)[free].max())
    assert by_array.axes.figure.axes[-1]._colorbar.extend == "min"
    assert drawn(simulation, "fixed").get_clim() == (0.0, 1.0)


def test_the_range_is_that_of_the_program(slope, program, tmp_path):
    """Whose bar is labelled with round values inside it; --range with the ends of Python changes nothing."""
    results = slope[0]
    low, high = drawn(results, "principal_stress").get_clim()
    command = ["plot", results.folder, "--field", "principal_stress", "-o"]
    program(*command, tmp_path / "as_it_is.svg")
    program(*command, tmp_path / "given.svg", f"--range={low!r},{high!r}")
    assert (tmp_path / "as_it_is.svg").read_bytes() == (tmp_path / "given.svg").read_bytes()


def test_blocks_that_are_all_held_or_at_rest_are_drawn():
    low, high = drawn(edda.Simulation(RING), "displacement").get_clim()
    assert low <= 0.0 <= high
    block = {"name": "floor", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "fixed": True}
    held = edda.Simulation({**{k: RING[k] for k in ("materials", "joints", "contact", "solver")}, "block": [block]})
    ax = edda.plot_blocks(held, "displacement")
    assert ax.collections[0].get_clim() == (0.0, 1.0)
    ax.figure.canvas.draw()


@pytest.mark.parametrize("which", ["results", "simulation"])
def test_principal_stresses_are_those_of_the_frames(tunnel, which):
    results, simulation = tunnel
    source = results if which == "results" else simulation
    frame = results.frames[-1]
    first = np.unique(frame["id"], return_index=True)[1]
    columns = {".major": 0, ".minor": 1, "": 1, ".out_of_plane": 2}
    for component, column in columns.items():
        values = drawn(source, "principal_stress" + component).get_array()
        assert np.allclose(values, frame["principal_stress"][first, column], rtol=1e-12, atol=1e-6)
    stress = frame["stress"][first]
    assert np.allclose(drawn(source, "stress").get_array(), 0.5 * (stress[:, 0] + stress[:, 1]))
    ax = edda.plot_blocks(source, "stress")
    assert ax.figure.axes[-1].get_ylabel() == "mean stress in the plane (Pa)"


def test_fields_that_are_not_there_are_told_with_those_that_are(tunnel, models):
    results, simulation = tunnel
    cut = edda.load(models / "ramp.toml").cut()
    for source, field, text in [
        (cut, "displacement", "no field of a cut is called 'displacement'.*known are id, material, fixed, area"),
        (cut, "rings", "no field of a cut"),
        (cut, "area.x", "no component of area"),
        (results, "displacment", "no field of frames is called 'displacment': did you mean 'displacement'"),
        (simulation, "stres", "no field is called 'stres': did you mean 'stress'"),
        (results, "stress.up", "no component of stress is called 'up': known are xx, yy, zz, xy"),
        (results, "principal_stress.0", "known are major, minor, out_of_plane"),
        (results, "rotation.x", "no component of rotation"),
        (simulation, "centroid", 'give "?centroid.x or centroid.y'),
        (results.contact_frames[-1], "slip", "holds no blocks"),
    ]:
        with pytest.raises(ValueError, match=text):
            edda.plot_blocks(source, field)
    assert not plt.get_fignums()  # no empty figure is left behind
    for source in (simulation, cut):
        for field in ("id", "material", "fixed", "area"):
            assert len(drawn(source, field).get_array()) > 0


def test_histories_are_named_with_their_units(slope):
    results, _ = slope
    monitor = next(n for n in results.history.dtype.names if n.endswith(".ux"))[:-3]
    ax = edda.plot_history(results, monitor + ".ux")
    assert ax.get_ylabel() == f"{monitor}.ux (m)" and ax.get_xlabel() == "time (s)"
    ax = edda.plot_history(results, ["kinetic", "strain"])
    assert ax.get_ylabel() == "energy (J)" and len(ax.figure.axes) == 1
    assert edda.plot_history(results, "unbalanced").get_ylabel() == "unbalanced"


def test_units_have_an_axes_each(slope):
    results, _ = slope
    monitor = next(n for n in results.history.dtype.names if n.endswith(".ux"))[:-3]
    columns = [monitor + ".ux", "kinetic", monitor + ".vx", monitor + ".uy", "drift", "unbalanced"]
    first = edda.plot_history(results, columns)
    axes = first.figure.axes
    labels = ["displacement (m)", "kinetic (J)", f"{monitor}.vx (m/s)", "drift", "unbalanced"]
    assert axes[0] is first and [a.get_ylabel() for a in axes] == labels
    assert [line.get_label() for line in axes[0].lines] == [monitor + ".ux", monitor + ".uy"]
    assert [a.get_xlabel() for a in axes] == ["", "", "", "", "time (s)"]
    figure, pair = plt.subplots(2)
    assert edda.plot_history(results, ["kinetic", "drift"], pair) is pair[0]
    assert len(pair[0].lines) == len(pair[1].lines) == 1 and len(figure.axes) == 2
    with pytest.raises(ValueError, match="1 axes for columns in J, m: give 2"):
        edda.plot_history(results, ["kinetic", monitor + ".ux"], pair[0])
    assert edda.plot_history(results, ["kinetic"], pair[1]) is pair[1]
    with pytest.raises(ValueError, match="no column of history.csv is called 'kinetik': did you mean 'kinetic'"):
        edda.plot_history(results, "kinetik")
    with pytest.raises(ValueError, match="no column is named"):
        edda.plot_history(results, [])


def test_all_kinds_of_sources_are_drawn(tunnel, models, tmp_path):
    results, _ = tunnel
    model = edda.load(models / "cavern.toml")
    simulation = edda.Simulation(model)
    simulation.step(5)
    for source, field in [
        (results, "displacement"),
        (results.frames[0], "stress.yy"),
        (simulation, "velocity.x"),
        (simulation, np.arange(simulation.block_count)),
        (model.cut(), "area"),
        (model.cut(), None),
    ]:
        ax = edda.plot_blocks(source, field, linewidths=0.2)
        drawn = ax.collections[0]
        if field is None:
            assert drawn.get_array() is None
        else:
            assert len(drawn.get_array()) == len(drawn.get_paths()) > 100
        plt.close(ax.figure)
    ax = edda.plot_history(results, ["kinetic", "strain"])
    assert np.array_equal(ax.lines[1].get_ydata(), results.history["strain"])
    ax.figure.savefig(tmp_path / "history.png")
    plt.close(ax.figure)


def test_a_crumb_does_not_darken_all_others(models):
    cut = edda.load(models / "cavern.toml").cut()
    free = np.array([not block.fixed for block in cut.blocks])
    area = np.array([block.area for block in cut.blocks])
    values = np.linspace(1e-3, 6e-3, len(area))
    values[~free] = 99.0  # held blocks do not count
    crumb = np.flatnonzero(free)[np.argmin(area[free])]

    def drawn(**options):
        ax = edda.plot_blocks(cut, values, **options)
        limits, bar = ax.collections[0].get_clim(), ax.figure.axes[-1]._colorbar
        plt.close(ax.figure)
        return limits[1], bar.extend

    values[crumb] = 0.167
    high, extend = drawn()
    assert extend == "max" and 6e-3 < high <= 9e-3
    assert drawn(clim=(0.0, 0.01)) == (0.01, "neither")
    assert drawn(whole_range=True) == (values.max(), "neither")
    values[~free] = values[crumb] = 5e-3
    assert drawn() == (values.max(), "neither")
