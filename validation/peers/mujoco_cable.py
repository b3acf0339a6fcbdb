#!/usr/bin/env python3
"""MuJoCo 3's rods: rigid bodies with ball joints and the cable plugin, which keeps their initial curvature.

usage: mujoco_cable.py HAIRS.json OUT.json [--many N]

Hairs are in units of their length, weight and fall. The settings are the best of those tested: steps of 0.0005 to 0.01 with the
integrators implicitfast and implicit, damping of joints of 0 to 0.02 and armature of 0 to 0.01.
"""
import argparse

import common  # first: it sets one thread
import mujoco
import numpy as np

RADIUS = 0.01
STEP, EVERY, DAMPING, ARMATURE = 0.002, 50, 0.01, 0.001


def model(hair, division):
    longer = division.chord / division.h
    bend = longer * hair.stiffness[0] / (0.25 * np.pi * RADIUS**4)
    twist = longer * hair.stiffness[2] / (0.5 * np.pi * RADIUS**4)
    vertices = " ".join(f"{x:.17g}" for x in division.points.ravel())
    m = mujoco.MjModel.from_xml_string(f"""
    <mujoco>
      <option timestep="{STEP}" gravity="0 0 -1" integrator="implicitfast">
        <flag contact="disable"/>
      </option>
      <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
      <worldbody>
        <composite type="cable" initial="none" vertex="{vertices}" prefix="hair">
          <plugin plugin="mujoco.elasticity.cable">
            <config key="twist" value="{twist:.17g}"/>
            <config key="bend" value="{bend:.17g}"/>
            <config key="flat" value="false"/>
          </plugin>
          <joint kind="main" damping="{DAMPING}" armature="{ARMATURE}"/>
          <geom type="capsule" size="{RADIUS}" mass="{division.h}"/>
        </composite>
      </worldbody>
    </mujoco>""")
    # Half of the last body is hair.
    m.body_mass[-1] *= 0.5
    m.body_ipos[-1] *= 0.5
    mujoco.mj_setConst(m, mujoco.MjData(m))
    return m


def attempt(hair, elements, steps):
    division = common.Division(hair, elements)
    m = model(hair, division)
    d = mujoco.MjData(m)

    def advance():
        mujoco.mj_step(m, d, nstep=EVERY)
        axis = d.xmat[-1].reshape(3, 3)[:, 0]
        # It restarts after a divergence, which is not convergence.
        if d.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            return np.full(3, np.nan)
        return d.xpos[-1] + 0.5 * division.chord * axis

    return common.come_to_rest(hair, (common.cpu(advance) for _ in range(steps // EVERY)))


def main():
    p = argparse.ArgumentParser()
    p.add_argument("hairs")
    p.add_argument("out")
    p.add_argument("--many", type=int, default=10)
    args = p.parse_args()
    one, many = common.read_hairs(args.hairs)
    mujoco.set_mju_user_warning(lambda text: None)
    points = []
    for elements, share in [(30, 1.0), (60, 1.0)]:
        alone = attempt(one, elements, 6000)
        ends = [attempt(hair, elements, 6000) for hair in many[: max(1, round(share * args.many))]]
        points.append(common.reported(common.summary(f"{elements} bodies", alone, ends, one.length)))
    common.write(args.out, "MuJoCo's cable plugin", mujoco.__version__, points)


if __name__ == "__main__":
    main()
