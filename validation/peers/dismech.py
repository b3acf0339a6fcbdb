#!/usr/bin/env python3
"""DiSMech-Newton: discrete elastic rods, implicit in time, on NVIDIA's Newton and Warp; here on the CPU.

usage: dismech.py HAIRS.json OUT.json [--many N]

Steps of implicit Euler as long as a fall (√(L/g)), with Gauss–Newton iterations of the whole energy (`exact`), are close to a
static solver; it computes in single precision. The stretching energy is that of a rod with a radius of 1/50 of the length, with
the bending and twist of the hair. Among the tested settings (steps of 0.3 to 100, 2 to 20 iterations, radii of L/50 to L/200, without
`exact`) this is one of the quickest, and leaves the fewest hairs in motion. Each hair is a separate simulation: in a common one they
share a line search, and one that diverges stops all. The times exclude building the model and compiling kernels.
"""
import argparse
from importlib.metadata import version

import common  # first: it sets one thread
import numpy as np
import warp as wp

wp.config.quiet = True
# Annotations of 0.1.0 such as `Slots | None` need Python 3.14, although it declares 3.10.
type(wp.struct(type("Empty", (), {"__annotations__": {"x": float}}))).__or__ = lambda a, b: a

import newton  # noqa: E402
from dismech_newton import DiSMechSolver  # noqa: E402
from dismech_newton.builder import add_rod  # noqa: E402

RADIUS, STEP, ITERATIONS, TRIALS = 0.02, 1.0, 3, 6


def build(hair, division):
    longer = division.chord / division.h
    builder = newton.ModelBuilder(gravity=wp.vec3(0.0, 0.0, -1.0))
    DiSMechSolver.register_custom_attributes(builder)
    stretch = 4 * hair.stiffness[0] / RADIUS**2
    rod = newton.Rod(
        division.points,
        radius=RADIUS,
        stretch_rigidity=stretch,
        shear_rigidity=stretch,
        bend_rigidity=longer * hair.stiffness[0],
        twist_rigidity=longer * hair.stiffness[2],
    )
    segments = add_rod(builder, rod, proxies=False, collide=False)
    DiSMechSolver.fix_segment(builder, edge=segments[0])
    for k, mass in enumerate(division.mass):
        builder.particle_mass[k] = float(mass)
    model = builder.finalize(device="cpu")
    solver = DiSMechSolver(model, iterations=ITERATIONS, exact=True, linesearch=TRIALS, self_contact=False)
    # The times also exclude the setup in the first step of a solver.
    solver.step(model.state(), model.state(), None, None, STEP)
    return solver, [model.state(), model.state()]


def attempt(hair, elements, steps):
    division = common.Division(hair, elements)
    solver, states = build(hair, division)

    def advance():
        solver.step(states[0], states[1], None, None, STEP)
        states.reverse()
        return division.tip(states[0].particle_q.numpy().astype(float))

    return common.come_to_rest(hair, (common.cpu(advance) for _ in range(steps)))


def main():
    p = argparse.ArgumentParser()
    p.add_argument("hairs")
    p.add_argument("out")
    p.add_argument("--many", type=int, default=100)
    args = p.parse_args()
    one, many = common.read_hairs(args.hairs)
    attempt(one, 10, 2)
    points = []
    for elements, share in [(30, 1.0), (45, 1.0), (60, 1.0), (90, 0.5), (120, 0.5)]:
        alone = [attempt(one, elements, 90) for _ in range(5)]
        alone = (alone[0][0], float(np.median([t for _, t in alone])))
        ends = [attempt(hair, elements, 90) for hair in many[: max(1, round(share * args.many))]]
        points.append(common.reported(common.summary(f"{elements} segments", alone, ends, one.length)))
    common.write(args.out, "DiSMech-Newton", version("dismech-newton"), points)


if __name__ == "__main__":
    main()
