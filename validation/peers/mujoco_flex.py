#!/usr/bin/env python3
"""MuJoCo 4's rods: discrete elastic rods as a 1-D flex, under its integrator that is implicit in position.

usage: mujoco_flex.py HAIRS.json OUT.json [--many N]

Hairs are in units of their length, weight and fall. The flex has bending and twist; equality constraints keep the lengths of its
edges. Tested were time steps from 0.005 to 1 (of √(L/g)) without and with damping, elastic and viscous: progress per step is
the same from 0.01 to 0.5, and 0.02 without damping is one of the quickest. The times exclude compiling the model.
"""
import argparse

import common  # first: it sets one thread
import mujoco
import numpy as np

# The section's radius; with the moduli, only its stiffness matters.
RADIUS = 0.01
STEP, EVERY = 0.02, 10


def model(hair, division):
    # Vertices store EI/(l0 + l1) with chords l instead of arcs.
    longer = division.chord / division.h
    young = longer * hair.stiffness[0] / (0.25 * np.pi * RADIUS**4)
    shear = longer * hair.stiffness[2] / (0.5 * np.pi * RADIUS**4)
    vertices = " ".join(f"{x:.17g}" for x in division.points.ravel())
    edges = " ".join(f"{k} {k + 1}" for k in range(len(division.points) - 1))
    m = mujoco.MjModel.from_xml_string(f"""
    <mujoco>
      <option timestep="{STEP}" gravity="0 0 -1" integrator="discrete" solver="Newton" iterations="50" tolerance="1e-12">
        <flag contact="disable"/>
      </option>
      <worldbody>
        <flexcomp name="hair" type="direct" dim="1" mass="1" radius="{RADIUS}" point="{vertices}" element="{edges}">
          <pin id="0 1"/>
          <edge equality="true" solref="1e-6 1" solimp="0.9999 0.9999 0.001"/>
          <elasticity young="{young:.17g}" shear="{shear:.17g}" poisson="0.3"/>
          <contact selfcollide="none" contype="0" conaffinity="0"/>
        </flexcomp>
      </worldbody>
    </mujoco>""")
    for body in range(1, m.nbody):
        name = m.body(body).name
        if "twist" not in name:
            m.body_mass[body] = division.mass[int(name.split("_")[-1])]
    mujoco.mj_setConst(m, mujoco.MjData(m))
    return m


def attempt(hair, elements, steps):
    division = common.Division(hair, elements)
    m = model(hair, division)
    d = mujoco.MjData(m)

    def advance():
        mujoco.mj_step(m, d, nstep=EVERY)
        return division.tip(d.flexvert_xpos)

    return common.come_to_rest(hair, (common.cpu(advance) for _ in range(steps // EVERY)))


def main():
    p = argparse.ArgumentParser()
    p.add_argument("hairs")
    p.add_argument("out")
    p.add_argument("--many", type=int, default=40)
    args = p.parse_args()
    one, many = common.read_hairs(args.hairs)
    points = []
    for elements, share in [(30, 1.0), (45, 1.0), (60, 1.0), (90, 0.5), (120, 0.25), (240, 0.1)]:
        alone = [attempt(one, elements, 12000) for _ in range(3)]
        alone = (alone[0][0], float(np.median([t for _, t in alone])))
        few = many[: max(1, round(share * args.many))]
        ends = [attempt(hair, elements, 12000) for hair in few]
        points.append(common.reported(common.summary(f"{elements} segments", alone, ends, one.length)))
    common.write(args.out, "MuJoCo's 1-D flex", mujoco.__version__, points)


if __name__ == "__main__":
    main()
