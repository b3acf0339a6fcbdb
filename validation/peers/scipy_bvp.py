#!/usr/bin/env python3
"""scipy's boundary-value solver on Kirchhoff's equations.

usage: scipy_bvp.py HAIRS.json OUT.json [--many N]

The unknowns are the vertical and the moment in the material frame: six equations, the smallest possible number, with analytic
Jacobians. The tip follows from the strain by a Magnus integrator of order four. The solver starts from the natural shape, with the
whole weight at once or with increasing weight in steps, each from the step before.
"""
import argparse
import warnings

import common
import numpy as np
import scipy
from common import cross_matrix
from scipy.integrate import solve_bvp

STEPS = {"at once": (1.0,), "in 4 steps": (0.1, 0.3, 0.6, 1.0), "in 10 steps": tuple(np.linspace(0.1, 1.0, 10))}
E3 = cross_matrix([0.0, 0.0, 1.0])


def crosses(v):
    """Matrices [v]x of the columns of v, as (3, 3, n)."""
    m = np.zeros((3, 3, v.shape[1]))
    m[0, 1], m[0, 2], m[1, 2] = -v[2], v[1], -v[0]
    m[1, 0], m[2, 0], m[2, 1] = v[2], -v[1], v[0]
    return m


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def solve(hair, tolerance, mesh, steps):
    """The strain as a function of arc length, or None."""
    # Moments in EI/L.
    gamma = 1.0 / hair.stiffness[0]
    soft = hair.stiffness[0] / hair.stiffness
    natural = hair.natural[:, None]
    zeta0 = hair.root[2]

    def strain(moment):
        return natural + soft[:, None] * moment

    s = np.linspace(0.0, 1.0, mesh)
    _, frames = hair.natural_frames(s)
    y = np.vstack([frames[:, 2, :].T, np.zeros((3, mesh))])
    for part in steps:
        weight = part * gamma

        def slope(s, y, weight=weight):
            zeta, moment = y[:3], y[3:]
            u, w = strain(moment), weight * (1.0 - s)
            turned = cross(moment, u)
            turned[0] -= w * zeta[1]
            turned[1] += w * zeta[0]
            return np.vstack([cross(zeta, u), turned])

        def jacobian(s, y, weight=weight):
            zeta, moment = y[:3], y[3:]
            u = crosses(strain(moment))
            j = np.zeros((6, 6, len(s)))
            j[:3, :3] = -u
            j[:3, 3:] = crosses(zeta) * soft[None, :, None]
            j[3:, :3] = E3[:, :, None] * (weight * (1.0 - s))
            j[3:, 3:] = -u + crosses(moment) * soft[None, :, None]
            return j

        last = part == steps[-1]
        found = solve_bvp(
            slope,
            lambda a, b: np.concatenate([a[:3] - zeta0, b[3:]]),
            s,
            y,
            fun_jac=jacobian,
            bc_jac=lambda a, b: (np.vstack([np.eye(3, 6), np.zeros((3, 6))]), np.vstack([np.zeros((3, 6)), np.eye(3, 6, 3)])),
            tol=tolerance if last else max(tolerance, 1e-2),
            max_nodes=1000,
        )
        if not found.success:
            return None
        s, y = found.x, found.y
    return lambda at: strain(found.sol(at)[3:])


def tip(hair, strain, intervals=192):
    """Tip of the hair of that strain: Magnus's series to order four, and Simpson's rule."""
    h = 1.0 / intervals
    # Half intervals, for the midpoints of Simpson's rule.
    left = np.arange(2 * intervals) * 0.5 * h
    gauss = 0.25 * h * np.array([1 - 1 / np.sqrt(3), 1 + 1 / np.sqrt(3)])
    u1, u2 = strain(left + gauss[0]), strain(left + gauss[1])
    turn = 0.25 * h * (u1 + u2) + np.sqrt(3) / 12 * (0.5 * h) ** 2 * cross(u1, u2)
    angle = np.maximum(np.linalg.norm(turn, axis=0), 1e-300)
    q = np.vstack([np.cos(0.5 * angle), np.sin(0.5 * angle) / angle * turn])
    # Running products, in doubling steps.
    step = 1
    while step < q.shape[1]:
        a, b = q[:, :-step], q[:, step:]
        product = np.vstack(
            [a[0] * b[0] - (a[1:] * b[1:]).sum(0), a[0] * b[1:] + b[0] * a[1:] + cross(a[1:], b[1:])]
        )
        q = np.hstack([q[:, :step], product])
        step *= 2
    w, x, y, z = np.hstack([[[1.0], [0.0], [0.0], [0.0]], q])
    t = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    weights = np.full(2 * intervals + 1, 2.0)
    weights[1::2] = 4.0
    weights[0] = weights[-1] = 1.0
    return hair.root @ (t @ weights) * h / 6.0


def attempt(hair, tolerance, mesh, steps):
    def work():
        strain = solve(hair, tolerance, mesh, steps)
        return None if strain is None else hair.error(tip(hair, strain))

    return common.cpu(work)


def main():
    p = argparse.ArgumentParser()
    p.add_argument("hairs")
    p.add_argument("out")
    p.add_argument("--many", type=int, default=1000)
    args = p.parse_args()
    one, many = common.read_hairs(args.hairs)
    warnings.simplefilter("ignore")
    attempt(one, 1e-2, 40, (1.0,))
    points = []
    for way, steps in STEPS.items():
        for tolerance, mesh in [(3.0, 24), (1.0, 32), (1e-2, 60), (1e-5, 120)]:
            alone = [attempt(one, tolerance, mesh, steps) for _ in range(5)]
            alone = (alone[0][0], float(np.median([t for _, t in alone])))
            few = many[: args.many]
            ends = [attempt(hair, tolerance, mesh, steps) for hair in few]
            setting = f"{way}, tolerance {tolerance:g}, {mesh} initial nodes"
            points.append(common.reported(common.summary(setting, alone, ends, one.length)))
    common.write(args.out, "scipy's solve_bvp", scipy.__version__, points)


if __name__ == "__main__":
    main()
