"""Domains: their boundaries turn once, enclose what they contain and split without gaps."""

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.stability.domains import Ellipse, Rectangle, Sector

RECTANGLE = Rectangle((-0.5, 1.5), (0.2, 0.9))
ELLIPSE = Ellipse(0.4 + 0.3j, (1.2, 0.7))
SECTOR = Sector(ELLIPSE, (0.4, 1.0), (2.0, 4.5))
DOMAINS = [RECTANGLE, ELLIPSE, SECTOR]


def scattered(count=400):
    rng = np.random.default_rng(3)
    return rng.uniform(-1, 2, count) + 1j * rng.uniform(-0.6, 1.2, count)


@pytest.mark.parametrize("domain", DOMAINS)
def test_boundary_winds_once_around_what_is_inside(domain):
    z = scattered()
    boundary = domain.points(np.linspace(0, 1, 4001)) - z[:, None]
    turns = np.angle(boundary[:, 1:] / boundary[:, :-1]).sum(axis=1) / (2 * np.pi)
    inside = domain.contains(z)
    assert 20 < inside.sum() < 380
    np.testing.assert_allclose(turns, inside, atol=1e-6)


@pytest.mark.parametrize("domain", DOMAINS)
def test_quadrature_gives_residues(domain):
    nodes, weights = domain.quadrature(400)
    inside, outside = domain.center, domain.center + 3 * domain.radius
    integral = ((1 / (nodes - inside) + 5 / (nodes - outside)) * weights).sum()
    assert abs(integral - 2j * np.pi) < 1e-9


@pytest.mark.parametrize("domain", DOMAINS)
def test_parts_cover_the_domain_without_overlap(domain):
    z = scattered()
    parts = [part for half in domain.split() for part in half.split()]
    covered = sum(part.contains(z).astype(int) for part in parts)
    assert np.array_equal(covered, domain.contains(z).astype(int))
    assert all(part.radius < domain.radius for part in parts)


@pytest.mark.parametrize("build", [lambda: Rectangle((1, 0), (0, 1)), lambda: Ellipse(0, (1, 0))])
def test_refuses_empty_domains(build):
    with pytest.raises(InputError):
        build()
