#!/usr/bin/env python3
"""PyElastica: Cosserat rods in motion, damped until they converge.

usage: pyelastica.py HAIRS.json OUT.json [--many N]

The stiffness of a rod in tension and shear limits the time step, so a real hair (a radius of 1/4000 of its
length) takes millions of steps. The comparison uses thicker rods of the same weight and the same stiffness in bending and
twist: the same statics except for stretch and shear, which reduce the accuracy. Radius, step and damping were chosen by trial. The many
hairs are rods of one simulation, which share the overhead of Python. The times exclude the first run, which compiles.
"""
import argparse

import common  # first: it sets one thread
import elastica as ea
import numpy as np
from elastica.version import VERSION

EVERY = 400


class Simulator(ea.BaseSystemCollection, ea.Constraints, ea.Forcing, ea.Damping):
    pass


def rod(hair, elements, radius):
    division = common.Division(hair, elements)
    t = np.diff(division.points, axis=0)
    t /= np.linalg.norm(t, axis=1)[:, None]
    # Directors along the chords, turned about them as the natural frames are.
    d1 = division.frames[:, :, 0]
    d1 = d1 - t * np.einsum("ki,ki->k", d1, t)[:, None]
    d1 /= np.linalg.norm(d1, axis=1)[:, None]
    made = ea.CosseratRod.straight_rod(
        elements + 1,
        division.points[0],
        t[0],
        d1[0].copy(),
        1.0 + division.h,
        radius,
        1.0 / (np.pi * radius**2),
        youngs_modulus=hair.stiffness[0] / (0.25 * np.pi * radius**4),
        shear_modulus=hair.stiffness[2] / (0.5 * np.pi * radius**4),
        position=division.points.T.copy(),
        directors=np.stack([d1, np.cross(t, d1), t]).transpose(0, 2, 1).copy(),
    )
    # The natural shape is the rest shape.
    made.compute_internal_forces_and_torques(0.0)
    made.rest_kappa[:] = made.kappa
    made.rest_sigma[:] = made.sigma
    made.mass[:] = division.mass
    return made


def attempts(hairs, elements, radius, step, damping, steps):
    """Ends of hairs in one simulation; seconds are each hair's share of it."""
    simulator = Simulator()
    rods = [rod(hair, elements, radius) for hair in hairs]
    for each in rods:
        simulator.append(each)
        simulator.constrain(each).using(ea.FixedConstraint, constrained_position_idx=(0, 1), constrained_director_idx=(0,))
        simulator.add_forcing_to(each).using(ea.GravityForces, acc_gravity=np.array([0.0, 0.0, -1.0]))
        simulator.dampen(each).using(ea.AnalyticalLinearDamper, uniform_damping_constant=damping, time_step=step)
    simulator.finalize()
    stepper, step, now = ea.PositionVerlet(), np.float64(step), np.float64(0.0)

    def advance():
        nonlocal now
        for _ in range(EVERY):
            now = stepper.step(simulator, now, step)

    tips, times = [], []
    for _ in range(steps // EVERY):
        _, seconds = common.cpu(advance)
        times.append(seconds / len(hairs))
        tips.append(np.array([common.Division.tip(each.position_collection.T) for each in rods]))
        if common.at_rest(tips):
            break
    return [common.come_to_rest(hair, ((tip[k], t) for tip, t in zip(tips, times))) for k, hair in enumerate(hairs)]


def main():
    p = argparse.ArgumentParser()
    p.add_argument("hairs")
    p.add_argument("out")
    p.add_argument("--many", type=int, default=20)
    args = p.parse_args()
    one, many = common.read_hairs(args.hairs)
    attempts([one], 10, 0.05, 1e-3, 1.0, 2 * EVERY)
    points = []
    for elements, radius, step, damping, share in [
        (45, 0.02, 5e-4, 2.0, 1.0),
        (60, 0.02, 5e-4, 2.0, 1.0),
        (60, 0.01, 3e-4, 1.0, 0.5),
        (90, 0.01, 2e-4, 1.0, 0.25),
        (120, 0.01, 1.5e-4, 1.0, 0.1),
    ]:
        steps = round(80.0 / step)
        alone = attempts([one], elements, radius, step, damping, steps)[0]
        ends = attempts(many[: max(1, round(share * args.many))], elements, radius, step, damping, steps)
        setting = f"{elements} elements, radius L/{1 / radius:.0f}, step {step:g}"
        points.append(common.reported(common.summary(setting, alone, ends, one.length)))
    common.write(args.out, "PyElastica", VERSION, points)


if __name__ == "__main__":
    main()
