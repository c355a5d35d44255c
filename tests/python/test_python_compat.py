# SPDX-License-Identifier: MIT
"""octocell.compat beside the functions that it stands in for."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np
import pytest
from exact import exact_pairs
from numpy.typing import NDArray

Numbers = NDArray[np.float64]


def points(count: int = 400, seed: int = 1) -> Numbers:
    return np.random.default_rng(seed).uniform(0, 5, (count, 3))


def lattice() -> Numbers:
    return np.stack(np.meshgrid(*[np.arange(5.0)] * 3), axis=-1).reshape(-1, 3)


def parameters(function: Any) -> list[tuple[str, Any, Any]]:
    listed = inspect.signature(function).parameters.values()
    return [(p.name, p.kind, p.default) for p in listed]


# SciPy


@pytest.mark.parametrize("r", [0.0, 0.5, 1.0, np.sqrt(2.0)])
@pytest.mark.parametrize("where", [points(), lattice(), points()[:, :2], points()[:, :1]])
def test_query_pairs_is_scipys(where: Numbers, r: float) -> None:
    spatial = pytest.importorskip("scipy.spatial")
    from octocell.compat.scipy import query_pairs

    tree = spatial.cKDTree(where)
    expected = tree.query_pairs(r)
    if r == np.sqrt(2.0) and len(where) == 125:  # SciPy's r * r is above 2; over the reals, too
        assert len(expected) > 500
    assert query_pairs(tree, r) == query_pairs(where, r) == expected
    array = query_pairs(tree, r, output_type="ndarray")
    assert array.dtype == tree.query_pairs(r, output_type="ndarray").dtype
    assert array.shape == (len(expected), 2) and set(map(tuple, array.tolist())) == expected


def test_query_pairs_has_scipys_signature() -> None:
    spatial = pytest.importorskip("scipy.spatial")
    from octocell.compat.scipy import query_pairs

    theirs = parameters(spatial.KDTree.query_pairs)[1:]  # cKDTree's cannot be inspected
    assert parameters(query_pairs)[1:] == theirs


def test_query_pairs_refuses_what_it_cannot_do() -> None:
    spatial = pytest.importorskip("scipy.spatial")
    from octocell.compat.scipy import query_pairs

    with pytest.raises(NotImplementedError, match="p=1"):
        query_pairs(points(), 1, p=1)
    with pytest.raises(NotImplementedError, match="periodic"):
        query_pairs(spatial.cKDTree(points(), boxsize=5), 1)
    with pytest.raises(ValueError, match="output_type='list'"):
        query_pairs(points(), 1, output_type="list")
    with pytest.raises(ValueError, match=r"shape \(3, 4\)"):
        query_pairs(np.zeros((3, 4)), 1)
    for r in (-1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="distance of"):
            query_pairs(points(), r)


def test_answers_are_exact_for_float64() -> None:
    """Tenths have no exact sum: half of these distances round up, half down."""
    from octocell.compat.scipy import query_pairs

    where = 0.1 * lattice()
    spheres = np.column_stack([where, np.full(125, 0.05)])
    expected = {tuple(pair) for pair in exact_pairs(spheres).tolist()}
    assert 0 < len(expected) < 300
    assert query_pairs(where, 0.1) == expected


# ASE


def rows(values: Any) -> list[Any]:
    return sorted(zip(*[np.round(v, 9).tolist() for v in values], strict=True))


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("kind", ["number", "elements", "radii"])
def test_neighbor_list_is_ases(kind: str, own: bool) -> None:
    ase = pytest.importorskip("ase")
    original = pytest.importorskip("ase.neighborlist").neighbor_list
    from octocell.compat.ase import neighbor_list

    random = np.random.default_rng(5)
    atoms = ase.Atoms(numbers=random.choice([1, 6, 8], 300), positions=points(300))
    cutoff: Any = {
        "number": 0.9,
        "elements": {("H", "H"): 0.7, (1, 6): 1.1, ("C", 8): 0.9},
        "radii": random.uniform(0.2, 0.6, 300),
    }[kind]
    theirs = original("ijdDS", atoms, cutoff, self_interaction=own)
    ours = neighbor_list("ijdDS", atoms, cutoff, self_interaction=own)
    assert [v.dtype for v in ours] == [v.dtype for v in theirs]
    assert [v.shape for v in ours] == [v.shape for v in theirs] and len(ours[0]) > 100
    assert rows(ours) == rows(theirs)
    assert (np.diff(ours[0]) >= 0).all()
    np.testing.assert_array_equal(neighbor_list("i", atoms, cutoff, own), ours[0])


def test_neighbor_list_leaves_out_what_is_just_at_the_cutoff() -> None:
    ase = pytest.importorskip("ase")
    original = pytest.importorskip("ase.neighborlist").neighbor_list
    from octocell.compat.ase import neighbor_list

    atoms = ase.Atoms(numbers=np.ones(125, int), positions=lattice())
    for cutoff in (1.0, np.nextafter(1.0, 2.0)):
        expected = rows(original("ij", atoms, cutoff))
        assert rows(neighbor_list("ij", atoms, cutoff)) == expected
    assert len(expected) == 600


def test_neighbor_list_has_ases_signature() -> None:
    original = pytest.importorskip("ase.neighborlist").neighbor_list
    from octocell.compat.ase import neighbor_list

    assert parameters(neighbor_list) == parameters(original)


def test_neighbor_list_refuses_what_it_cannot_do() -> None:
    ase = pytest.importorskip("ase")
    from octocell.compat.ase import neighbor_list

    atoms = ase.Atoms("H3", np.zeros((3, 3)), cell=[3, 3, 3], pbc=[True, False, False])
    with pytest.raises(NotImplementedError, match="periodic"):
        neighbor_list("i", atoms, 1.0)
    atoms.pbc = False
    with pytest.raises(ValueError, match="quantities='ix'"):
        neighbor_list("ix", atoms, 1.0)
    with pytest.raises(ValueError, match=r"shape \(2,\): must be \(3,\)"):
        neighbor_list("i", atoms, [1.0, 1.0])


# scikit-learn


@pytest.mark.parametrize("mode", ["connectivity", "distance"])
@pytest.mark.parametrize("own", [False, True, "auto"])
@pytest.mark.parametrize("where", [points(), lattice(), points()[:, :2]])
def test_radius_neighbors_graph_is_sklearns(where: Numbers, mode: str, own: bool | str) -> None:
    original = pytest.importorskip("sklearn.neighbors").radius_neighbors_graph
    from octocell.compat.sklearn import radius_neighbors_graph

    theirs = original(where, 1.0, mode=mode, include_self=own)
    ours = radius_neighbors_graph(where, 1.0, mode=mode, include_self=own)
    assert type(ours) is type(theirs) and ours.dtype == theirs.dtype and ours.nnz == theirs.nnz
    theirs.sort_indices()
    np.testing.assert_array_equal(ours.indptr, theirs.indptr)
    np.testing.assert_array_equal(ours.indices, theirs.indices)
    np.testing.assert_allclose(ours.data, theirs.data, rtol=1e-9)


def test_radius_neighbors_graph_has_sklearns_signature() -> None:
    original = pytest.importorskip("sklearn.neighbors").radius_neighbors_graph
    from octocell.compat.sklearn import radius_neighbors_graph

    assert parameters(radius_neighbors_graph) == parameters(original)


def test_radius_neighbors_graph_refuses_what_it_cannot_do() -> None:
    pytest.importorskip("scipy.sparse")
    from octocell.compat.sklearn import radius_neighbors_graph

    with pytest.raises(NotImplementedError, match="metric='manhattan'"):
        radius_neighbors_graph(points(), 1, metric="manhattan")
    with pytest.raises(NotImplementedError, match="p=1"):
        radius_neighbors_graph(points(), 1, p=1)
    with pytest.raises(ValueError, match="mode='both'"):
        radius_neighbors_graph(points(), 1, mode="both")


# PyTorch


@pytest.mark.parametrize("flow", ["source_to_target", "target_to_source"])
@pytest.mark.parametrize("loop", [False, True])
def test_radius_graph_joins_all_points_of_a_batch(flow: str, loop: bool) -> None:
    torch = pytest.importorskip("torch")
    from octocell.compat.torch import radius_graph

    where = points(200)
    batch = np.arange(200) % 3
    edges = radius_graph(torch.tensor(where), 4.0, torch.tensor(batch), loop, flow=flow).numpy()
    apart = ((where[:, None] - where[None]) ** 2).sum(axis=2)
    joined = (apart < 16.0) & (batch[:, None] == batch[None])
    if not loop:
        np.fill_diagonal(joined, False)
    assert joined.sum(axis=1).max() > 33, "the original would leave some out"
    target = edges[1] if flow == "source_to_target" else edges[0]
    assert (np.diff(target) >= 0).all()
    assert {tuple(edge) for edge in edges.T.tolist()} == set(zip(*np.nonzero(joined), strict=True))


def test_radius_graph_is_torch_clusters() -> None:
    torch = pytest.importorskip("torch")
    original = pytest.importorskip("torch_cluster").radius_graph
    from octocell.compat.torch import radius_graph

    assert parameters(radius_graph) == parameters(original)
    where, batch = torch.tensor(points(300), dtype=torch.float32), torch.arange(300) // 150
    theirs = original(where, 1.0, batch, max_num_neighbors=300)
    ours = radius_graph(where, 1.0, batch)
    assert set(map(tuple, ours.T.tolist())) == set(map(tuple, theirs.T.tolist()))


def test_tensors_come_back_as_tensors() -> None:
    torch = pytest.importorskip("torch")
    import octocell

    spheres = torch.tensor(np.column_stack([points(), np.full(400, 0.3)]), dtype=torch.float32)
    expected = exact_pairs(spheres.numpy())
    found = octocell.pairs(spheres)
    assert isinstance(found.i, torch.Tensor) and found.i.dtype == torch.int32
    np.testing.assert_array_equal(found.array.numpy(), expected)
    assert isinstance(found.to_edge_index(), torch.Tensor)
    spheres.requires_grad_(True)
    np.testing.assert_array_equal(octocell.pairs(spheres).array.numpy(), expected)
