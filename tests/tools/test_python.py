"""The Python module: worlds, arrays of their numbers, scenes, sweeps, films, and refused input."""

import ast
import contextlib
import copy
import csv
import gc
import importlib
import inspect
import io
import json
import math
import os
import pickle
import re
import subprocess
import sys
import tempfile
import textwrap
import threading
import unittest
import warnings
import zipfile
from fractions import Fraction
from pathlib import Path
from unittest import mock

from sandbox import ROOT

import numpy as np
from needs import PYTHON_NEEDS, VIEW_NEEDS
from python import built

lacking = [need.package for need in PYTHON_NEEDS if not need.there() or need.too_old()]
if not lacking:
    SITE = built()
    sys.path.insert(0, str(SITE))
    spook = importlib.import_module("spook")
STUB = ROOT / "tools" / "python" / "spook" / "_spook.pyi"


class WithModule(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if lacking:
            raise unittest.SkipTest(f"the Python module needs {' and '.join(lacking)}")

    def refused(self, what: str, call, *arguments, **named) -> None:
        with self.assertRaises(ValueError) as caught:
            call(*arguments, **named)
        self.assertEqual(str(caught.exception), what)


def falling(bodies: int = 1):
    world = spook.PointWorld(gravity=(0, 0, -10))
    for k in range(bodies):
        world.add(x=(k, 0, 0))
    return world


class Worlds(WithModule):
    def test_a_body_falls_as_leapfrog_says(self):
        world, h, n = falling(), 0.25, 8  # all of it is exact in binary
        world.step(h, steps=n)
        self.assertEqual(world.x[0, 2], -10 * h * h * n * (n + 1) / 2)
        self.assertEqual(world.v[0, 2], -10 * h * n)
        self.assertEqual((world.time, world.steps, len(world)), (n * h, n, 1))

    def test_many_steps_in_one_call_are_as_many_calls(self):
        one, other = box_on_plane(), box_on_plane()
        one.step(1 / 60, steps=30)
        for _ in range(30):
            other.step(1 / 60)
        np.testing.assert_array_equal(one.x, other.x)
        np.testing.assert_array_equal(one.q, other.q)

    def test_static_bodies_that_move_carry_what_lies_on_them(self):
        for velocity in ("set_velocity", "set_surface_velocity"):
            world = spook.World(friction=0.5)
            under = world.add_fixed((0, 0, -0.1), half_sides=(9, 1, 0.1))
            box = world.add(x=(0, 0, 0.2), half_sides=(0.2, 0.2, 0.2))
            getattr(world, velocity)(under, (1, 0, 0))
            world.step(1 / 60, steps=60)
            self.assertAlmostEqual(world.v[box, 0], 1, 6)
            self.assertAlmostEqual(world.x[under, 0], 1 if velocity == "set_velocity" else 0, 9)
            self.assertEqual(world.state, "sound")
        points = spook.PointWorld(gravity=(0, 0, 0))
        nail = points.add_fixed((0, 0, 0))
        points.set_velocity(nail, (0, 2, 0))
        points.step(0.5)
        self.assertEqual(points.x[nail, 1], 1)

    def test_a_lift_follows_keyframes_or_a_function(self):
        for way in ("keyframes", "function"):
            world = spook.World()
            lift = world.add_fixed((0, 0, 0), half_sides=(1, 1, 0.1))
            box = world.add(x=(0, 0, 0.3), half_sides=(0.2, 0.2, 0.2))
            if way == "keyframes":
                turned = (math.cos(0.25), 0, 0, math.sin(0.25))
                world.set_keyframes(lift, [0, 1], np.array([[0, 0, 0], [0, 0, 0.5]]), q=np.array([[1, 0, 0, 0], turned]))
            else:
                world.set_velocity_function(lift, lambda t: (0, 0, t), lambda t: np.array([0, 0, 0.5]))
            world.step(1 / 60, steps=60)
            self.assertAlmostEqual(world.x[lift, 2], 0.5, 9)  # of v = t, the middle of a step has the mean
            self.assertAlmostEqual(world.x[box, 2], 0.8, 3)
            self.assertAlmostEqual(world.q[lift, 3], math.sin(0.25), 9)
            self.assertEqual(world.state, "sound", world.reason)
        points = spook.PointWorld()
        nail = points.add_fixed((0, 0, 0))
        points.set_velocity_function(nail, lambda t: (1, 0, 0))
        points.step(0.5)
        self.assertEqual(points.x[nail, 0], 0.5)
        points.set_keyframes(nail, [0.5, 1.5], np.array([[0, 0, 0], [0, 2, 0]]))
        self.assertEqual(points.x[nail].tolist(), [0, 0, 0])
        copied = points.save()
        for one in (points, copied):
            one.step(0.5)
            self.assertAlmostEqual(one.x[nail, 1], 1)
        self.refused("x must have a row for each of 2 times, but has 1", points.set_keyframes, nail, [0, 1], np.zeros((1, 3)))
        points.set_velocity_function(nail, lambda t: "up")
        with self.assertRaisesRegex(TypeError, "v must return three numbers, but returned 'up'"):
            points.step(0.5)
        points.set_velocity_function(nail, lambda t: 1 / 0)
        steps = points.steps
        with self.assertRaises(ZeroDivisionError):
            points.step(0.5)
        self.assertEqual(points.steps, steps)  # that step never was
        points.set_velocity_function(nail, lambda t: (points.x[nail, 0], 0, 0))
        with self.assertRaisesRegex(RuntimeError, "^a velocity function cannot use its world, which is taking a step$"):
            points.step(0.5)
        world = spook.World()
        self.refused("part of v along the plane's normal must be 0, but is 1", world.set_surface_velocity, world.add_plane(),
                     (1, 0, 1))

    def test_velocities_lag_by_half_a_part_of_a_step(self):
        h, omega = 1 / 60, 30
        world = spook.World(gravity=(0, 0, 0))
        nail, ball = world.add_fixed((0, 0, 0)), world.add(x=(1, 0, 0), v=(0, omega, 0), mass=1, radius=0.1)
        world.add_joint(nail, ball, length=1)
        self.assertEqual((world.parts, world.velocity_lag(h)), (1, h / 2))
        world.step(h, steps=30)
        self.assertGreater(world.parts, 1)
        self.assertEqual(world.velocity_lag(h), h / world.parts / 2)
        (x, y, _), (u, v, _) = world.x[ball], world.v[ball]
        behind = math.atan2(y, x) - math.atan2(-u, v)  # a velocity is a right angle ahead of its position
        self.assertAlmostEqual(math.remainder(behind, 2 * math.pi), omega * world.velocity_lag(h), delta=0.01)
        self.assertEqual(spook.World(integrator_order=4).velocity_lag(h), 0)
        for of in (world.velocity_lag, lambda h: world.synchronized_velocity(ball, h),
                   lambda h: world.synchronized_angular_velocity(ball, h)):
            self.refused("h must be positive and finite, but is -1", of, -1)

    def test_a_force_without_a_finite_stiffness_is_told_and_does_no_harm(self):
        world = box_on_plane()
        world.set_force(1, (1e308, 0, 0))
        with self.assertRaisesRegex(ValueError, "^sum of all forces must be so small that the default k of contacts is finite"):
            world.step(1 / 60)
        world.set_force(1, (0, 0, 0))
        world.step(1 / 60)
        self.assertEqual((world.steps, world.state), (1, "sound"))

    def test_bodies_of_a_list_do_not_touch(self):
        for excluded in (False, True):
            world = spook.World()
            world.add_plane()
            for _ in range(3):
                world.add(x=(0, 0, 0.05), radius=0.1)
            if excluded:
                world.exclude_contacts([1, 2, 3])
            world.step(1e-6)
            contacts = world.contacts()
            between = np.count_nonzero(contacts["i"] * contacts["j"])
            self.assertEqual((between, len(contacts["gap"])), (0, 3) if excluded else (3, 6))
        self.refused("body must be listed once, but is 1", world.exclude_contacts, [1, 1])

    def test_a_spring_holds_and_a_rope_catches(self):
        world = spook.World()
        top, weight = world.add_fixed((0, 0, 0)), world.add(mass=2, principal=(1, 1, 1))
        slider = world.add_slider(top, weight, spring=(200, 20, -0.5))
        world.step(1 / 60, steps=1200)
        self.assertAlmostEqual(world.joint_position(slider), -0.5 - 2 * 9.81 / 200, 6)
        self.assertAlmostEqual(world.spring_force(slider), 2 * 9.81, 6)
        # The slider's rows carry nothing.
        self.assertAlmostEqual(world.energy["springs"], (2 * 9.81) ** 2 / (2 * 200), 6)
        world.set_spring(slider, (400, 20))
        world.step(1 / 60, steps=1200)
        self.assertAlmostEqual(world.joint_position(slider), -2 * 9.81 / 400, 6)
        self.refused("stiffness must be positive where damping is 0, but is 0", world.set_spring, slider, (0, 0))
        self.refused("spring must have a stiffness, a damping and a rest, but has 0 numbers", world.set_spring, slider, ())
        for world in (spook.World(), spook.PointWorld()):
            nail, ball = world.add_fixed((0, 0, 0)), world.add(x=(0, 0, -0.2), radius=0.1)
            rope = world.add_rope(nail, ball, 1)
            world.step(1 / 240, steps=24)
            self.assertEqual(world.joint_force(rope).tolist(), [0, 0, 0])
            world.step(1 / 240, steps=240)
            self.assertAlmostEqual(world.x[ball, 2], -1, 4)
            self.assertAlmostEqual(world.joint_force(rope)[2], 9.81, 4)
            self.assertEqual(world.joints()["kind"], ["rope"])

    def test_steps_are_divided_at_most_so_often(self):
        off = []
        for max_parts in (32, 1):
            world = spook.World(gravity=(0, 0, 0), max_parts=max_parts, check=False)
            nail, ball = world.add_fixed((0, 0, 0)), world.add(x=(1, 0, 0), v=(0, 60, 0), radius=0.1)
            world.add_joint(nail, ball, length=1)
            world.step(1 / 60, steps=60)
            off.append(abs(np.linalg.norm(world.x[ball]) - 1))
        self.assertLess(off[0], 0.01)
        self.assertGreater(off[1], 0.05)
        self.refused("max_parts must be a power of two from 1 to 1024, but is 3", lambda: spook.World(max_parts=3))

    def test_threads_change_no_bit(self):
        worlds = [spook.World(friction=0.5, solver="spatial_decomposition", threads=threads) for threads in (1, 2)]
        for world in worlds:
            world.add_plane((0, 0, 1), 0)
            for k in range(1000):
                world.add(x=(0.199 * (k % 10), 0.199 * (k // 10 % 10), 0.1 + 0.199 * (k // 100)), radius=0.1)
            world.step(1 / 240, steps=5)
        np.testing.assert_array_equal(worlds[0].x, worlds[1].x)
        self.refused("threads must be from 1 to 256, but is 0", lambda: spook.World(threads=0))

    def test_a_box_at_rest_is_held_by_its_weight(self):
        world, h = box_on_plane(), 1 / 60
        world.step(h, steps=240)
        contacts = world.contacts()
        self.assertEqual(len(contacts["gap"]), 4)
        # λ = h m g in all, to what is left of the settling after 240 steps.
        np.testing.assert_allclose(contacts["impulse"].sum(axis=0), [0, 0, h * 2 * 9.81], atol=1e-9)
        np.testing.assert_allclose(contacts["normal_impulse"].sum(), h * 2 * 9.81, rtol=1e-9)
        np.testing.assert_array_equal(contacts["normal"], np.tile([0, 0, 1], (4, 1)))
        self.assertEqual(world.report()["contacts"], 4)

    def test_a_ball_that_bounces_is_in_impacts(self):
        h = 1 / 240
        world = spook.World(restitution=1)
        floor = world.add_plane()
        ball = world.add(x=(0, 0, 1.1), radius=0.1)
        while not len(world.impacts()["speed"]):
            self.assertLess(world.time, 1)
            world.step(h)
        impacts = world.impacts()
        self.assertEqual({int(impacts["i"][0]), int(impacts["j"][0])}, {floor, ball})
        # It falls by 1 m, and is found at most one step late.
        self.assertAlmostEqual(impacts["speed"][0], np.sqrt(2 * 9.81), delta=9.81 * h)

    def test_a_pendulum_at_rest_pulls_with_its_weight(self):
        world, h = spook.PointWorld(), 1 / 60
        fixed, bob = world.add_fixed((0, 0, 0)), world.add(x=(0, 0, -1), mass=3)
        joint = world.add_joint(fixed, bob, length=1)
        world.step(h, steps=240)
        np.testing.assert_allclose(np.abs(world.joint_impulse(joint)), [h * 3 * 9.81], rtol=1e-9)
        world.remove_joint(joint)
        self.refused("joint is 0, where there is none", world.joint_impulse, joint)

    def test_a_motor_turns_a_wheel_to_its_limit(self):
        world, h = spook.World(gravity=(0, 0, 0)), 0.01
        fixed, wheel = world.add_fixed((0, 0, 0)), world.add(mass=1, principal=(1, 2, 2))
        hinge = world.add_hinge(fixed, wheel, axis=(1, 0, 0), limits=(-1, 2), motor=(0.5, 3))
        world.step(h, steps=100)
        np.testing.assert_allclose(world.joint_speed(hinge), 0.5, rtol=1e-9)  # in a third of a second
        world.step(h, steps=900)
        np.testing.assert_allclose(world.joint_position(hinge), 2, atol=1e-9)  # no motor drives past a limit, Eq. (13.17)
        # It presses on the limit with its strength.
        np.testing.assert_allclose([world.motor_force(hinge), world.limit_force(hinge)], [3, -3], atol=1e-9)
        world.set_motor(hinge, (-1, 1))
        world.step(h, steps=100)
        np.testing.assert_allclose(world.joint_speed(hinge), -1, rtol=1e-9)
        slider = world.add_slider(fixed, world.add(principal=(1, 1, 1)), k=1e6)
        weld = world.add_weld(fixed, world.add(principal=(1, 1, 1)))
        world.apply_central_impulse(2, (1, 1, 1))
        world.step(h)
        np.testing.assert_allclose(world.joint_position(slider), h, rtol=1e-9)
        np.testing.assert_allclose(world.joint_torque(weld), 0, atol=1e-12)
        # A joint with d = 1/4 takes the part b = 4d/(1 + 4d) = 1/2 of a blow in a step, Eq. (3.5), but for what its spring
        # gives way, S/(S + Sigma) with S = 1/m; of the rest it takes as much in the next, until all of it is taken.
        sigma = 4 / (h**2 * 1e6 * 2)
        np.testing.assert_allclose(world.joint_force(slider), [-0.5 / (1 + sigma) / h] * 2 + [0], rtol=1e-9)
        taken = h * world.joint_force(slider)
        for _ in range(100):
            world.step(h)
            taken += h * world.joint_force(slider)
        np.testing.assert_allclose(taken, [-1, -1, 0], atol=1e-9)

    def test_a_world_that_is_lost_says_so_once(self):
        # A heavy load on light hinged boxes, thrown: at this step the joints bring in energy.
        def chain(check=True):
            world = spook.World(check=check)
            last = world.add_fixed((0, 0, 0))
            for k in range(30):
                body = world.add(x=(0.1 + 0.2 * k, 0, 0), mass=500 if k == 29 else 1, half_sides=(0.1, 0.02, 0.02))
                world.add_hinge(last, body, (0.1 if k else 0, 0, 0), (-0.1, 0, 0), axis=(0, 1, 0))
                last = body
            world.apply_central_impulse(last, (0, 0, 500 * 30))
            return world

        world = chain()
        self.assertEqual((world.state, world.reason, world.note), ("sound", "", ""))
        with self.assertWarns(RuntimeWarning) as caught:
            with contextlib.suppress(spook.SimulationDiverged):
                world.step(1 / 30, steps=300)
        self.assertRegex(str(caught.warning), r"^the world is lost in step \d+: \S")
        self.assertEqual(world.state, "lost")
        self.assertIn(world.reason, str(caught.warning))
        self.assertEqual(copy.copy(world).state, "lost")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with contextlib.suppress(spook.SimulationDiverged):
                world.step(1 / 30)
            unchecked = chain(check=False)
            self.assertEqual(unchecked.state, "unchecked")
            with contextlib.suppress(spook.SimulationDiverged):
                unchecked.step(1 / 30, steps=30)
            self.assertEqual((unchecked.state, unchecked.save().state), ("unchecked", "unchecked"))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            fresh = chain()
            with self.assertRaises((RuntimeWarning, spook.SimulationDiverged)):
                fresh.step(1 / 30, steps=300)

    def test_a_world_that_diverged_does_not_warn_later(self):
        world = falling()
        world.place(0, v=(1e308, 0, 0))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(spook.SimulationDiverged):
                world.step(10, steps=2)
            self.assertEqual(world.state, "lost")
            world.place(0, x=(0, 0, 0), v=(0, 0, 0))
            world.step(0.1)  # the exception was the warning

    def test_a_passage_is_noted_in_the_first_step_and_in_one_after_a_body_was_placed(self):
        world = spook.World(gravity=(0, 0, 0))
        wall = world.add_fixed((1, 0, 0), half_sides=(0.05, 1, 1))
        ball = world.add(x=(0, 0, 0), v=(100, 0, 0), radius=0.1)
        saved = world.save()
        world.step(1 / 60)
        self.assertIn(f"body {ball} moves by 1.67 m in a step relative to body {wall}", world.note)
        world.restore(saved)
        world.place(ball, v=(0, 0, 0))
        world.step(1 / 60, steps=3)
        self.assertEqual(world.note, "")
        world.place(ball, v=(100, 0, 0))
        world.step(1 / 60)
        self.assertIn(f"body {ball} moves by 1.67 m in a step relative to body {wall}", world.note)

    def test_what_moves_bodies_from_outside_is_not_taken_for_a_mistake(self):
        world = box_on_plane()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for k in range(60):
                world.apply_central_impulse(1, (0, 0, 100))
                world.place(1, x=(0, 0, k))
                world.turn(1, omega=(0, 0, 100 * k))
                world.step(1 / 60)
        self.assertEqual(world.state, "sound")

    def test_what_holds_a_weight_has_the_energy_of_a_spring(self):
        m, g, k, h = 3, 9.81, 1e4, 1 / 60
        standing = spook.World(k=k)
        standing.add_plane((0, 0, 1))
        standing.add(x=(0, 0, 0.1), mass=m, radius=0.1)
        hanging = spook.World(k=k)
        hanging.add_joint(hanging.add_fixed((0, 0, 0)), hanging.add(x=(0, 0, -1), mass=m, principal=(1, 1, 1)), length=1)
        for world in (standing, hanging):
            self.assertEqual(world.energy["springs"], 0)
            world.step(h, steps=600)
            self.assertAlmostEqual(world.energy["springs"] / ((m * g) ** 2 / (2 * k)), 1, 6)
            saved = world.save()
            world.step(1 / 30)
            world.restore(saved)
            self.assertAlmostEqual(world.energy["springs"] / ((m * g) ** 2 / (2 * k)), 1, 6)

    def test_energy_goes_over_from_one_kind_to_the_other(self):
        h, n, m, g = 1 / 256, 64, 3, 8
        world = spook.PointWorld(gravity=(0, 0, -g))
        world.add(x=(0, 0, 5), mass=m)
        self.assertEqual(world.energy, {"kinetic": 0, "potential": m * g * 5, "springs": 0})
        world.step(h, steps=n)  # all of it is exact in binary; the speed is half a step behind
        self.assertEqual(world.energy, {"kinetic": m * (g * h * n) ** 2 / 2, "potential": m * g * (5 - g * h * h * n * (n + 1) / 2),
                                        "springs": 0})
        world.add_fixed((0, 0, 0))
        np.testing.assert_array_equal(world.masses, [m, math.inf])

    def test_a_body_slides_as_its_material_says_on_a_static_box(self):
        def slid(friction, other=False):
            world = spook.World(friction=0.9)
            floor = world.add_fixed((0, 0, -1), half_sides=(50, 50, 1))
            box = world.add(x=(0, 0, 0.1), v=(3, 0, 0), half_sides=(0.1, 0.1, 0.1))
            world.set_material(box, floor if other else None, friction=friction)
            world.step(1 / 240, steps=480)
            return world.x[box, 0]

        # v^2/(2 mu g), to half a step of v; of two materials the mean is geometric.
        self.assertAlmostEqual(slid(0.4, other=True), 9 / (2 * 0.4 * 9.81), delta=3 / 240)
        self.assertAlmostEqual(slid(0.4), 9 / (2 * 0.6 * 9.81), delta=3 / 240)
        self.refused("friction must be zero or positive, and finite, but is -1", slid, -1)

    def test_static_shapes_hold_what_lies_on_them(self):
        for shape, top in (({"radius": 0.5}, 0.5), ({"half_sides": (1, 1, 0.25)}, 0.25),
                           ({"radius": 0.2, "half_length": 1}, 1.2), ({"half_sides": (0.1, 1, 1), "q": (0.5**0.5, 0, 0.5**0.5, 0)}, 0.1)):
            with self.subTest(**shape):
                world = spook.World()
                static = world.add_fixed((0, 0, 0), **shape)
                ball = world.add(x=(0, 0, top + 0.1), radius=0.1)
                world.step(1 / 240, steps=240)
                self.assertAlmostEqual(world.x[ball, 2], top + 0.1, delta=1e-3)
                np.testing.assert_allclose(world.contact_force(0), [0, 0, 9.81], rtol=1e-6, atol=1e-9)
                np.testing.assert_allclose(world.contacts()["force"], [[0, 0, 9.81]], rtol=1e-6, atol=1e-9)
                self.assertEqual(world.contacts()["i"][0], static)
        with self.assertRaises(ValueError):
            spook.World().add_fixed((0, 0, 0), radius=1, half_sides=(1, 1, 1))

    def test_a_ray_hits_the_first_body_and_a_ball_overlaps_the_near_ones(self):
        world = spook.World()
        floor = world.add_plane()
        box = world.add(x=(0, 0, 1), half_sides=(1, 1, 0.5))
        capsule = world.add(x=(4, 0, 1), radius=0.5, half_length=0.5)
        hit = world.cast_ray((0.5, 0, 5), (0, 0, -2))
        self.assertEqual((hit["body"], hit["distance"]), (box, 3.5))
        self.assertEqual((hit["point"].tolist(), hit["normal"].tolist()), ([0.5, 0, 1.5], [0, 0, 1]))
        self.assertIsNone(world.cast_ray((0.5, 0, 5), (0, 0, -2), longest=3.4))
        self.assertEqual(world.cast_ray((0.5, 0, 1), (1, 0, 0))["body"], capsule)  # it begins in the box
        self.assertEqual(world.overlapping((0, 0, 0), 0.5), [floor, box])
        self.assertEqual(world.overlapping((4, 0, 1), radius=0), [capsule])
        points = falling()
        self.assertEqual((points.cast_ray((0, 0, 1), (0, 0, -1)), points.overlapping((0, 0, 0), 1)), (None, []))
        self.refused("direction must be a vector that is not zero, but is 0", world.cast_ray, (0, 0, 1), (0, 0, 0))
        self.refused("radius must be zero or positive, and finite, but is -1", world.overlapping, (0, 0, 1), -1)
        with self.assertRaisesRegex(TypeError, "^cast_ray: direction: three numbers, got 2$"):
            world.cast_ray((0, 0, 1), (0, 1))

    def test_a_body_that_is_taken_out_takes_its_force_along(self):
        world = spook.PointWorld(gravity=(0, 0, 0))
        for k in range(3):
            world.add(x=(k, 0, 0))
        world.set_force(0, (1, 0, 0))
        world.set_force(2, (0, 2, 0))
        view = world.x
        with self.assertRaises(BufferError):
            world.remove_body(0)
        del view
        gc.collect()
        world.remove_body(0)
        world.step(1)
        np.testing.assert_array_equal(world.v, [[0, 0, 0], [0, 2, 0]])

    def test_a_word_of_a_setting_that_is_not_known_is_named(self):
        self.refused('unknown tangents "slidin"; did you mean "sliding"?', lambda: spook.World(tangents="slidin"))
        self.refused('unknown rotation "first order"; did you mean "first_order"?', lambda: spook.World(rotation="first order"))

    def test_joints_are_arrays(self):
        world = spook.World()
        nail = world.add_fixed((0, 0, 0))
        bob = world.add(x=(0, 0, -1), mass=3, principal=(1, 1, 1))
        world.add_joint(nail, bob, (0, 0, 0), (0, 0, 1))
        world.step(1 / 240, steps=480)
        joints = world.joints()
        self.assertEqual((joints["kind"], list(joints["i"]), list(joints["j"])), (["ball"], [nail], [bob]))
        np.testing.assert_allclose(joints["force"], [[0, 0, 3 * 9.81]], rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(joints["torque"], [[0, 0, 0]], atol=1e-9)

    def test_other_threads_run_while_a_world_steps_and_cannot_touch_it(self):
        world = falling(200)
        said, counted = [], 0
        thread = threading.Thread(target=lambda: world.step(1e-6, steps=200_000))
        thread.start()
        while thread.is_alive():
            counted += 1
            try:
                world.place(0, x=(0, 0, 0))
            except RuntimeError as error:
                said.append(str(error))
        thread.join()
        self.assertGreater(counted, 100)
        self.assertIn("the world is taking a step in another thread", said)
        self.assertEqual(world.steps, 200_000)

    def test_help_says_what_an_editor_shows(self):
        self.assertEqual(spook.__version__, re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1])
        stub = ast.parse(STUB.read_text(encoding="utf-8"))
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        for name, known in (("World", spook.World), ("PointWorld", spook.PointWorld)):
            for node in classes["_EitherWorld"].body + classes[name].body:
                if isinstance(node, ast.FunctionDef) and (text := ast.get_docstring(node)):
                    if name == "World" or node.name != "add_fixed":
                        self.assertIn(text.split()[0], inspect.getdoc(getattr(known, node.name)) or "", f"{name}.{node.name}")

    def test_a_force_pushes_and_a_torque_turns_until_they_are_set_anew(self):
        world = spook.World(gravity=(0, 0, 0))
        body = world.add(mass=2, principal=(4, 4, 4))
        world.set_force(body, (8, 0, 0), torque=(0, 0, 2))
        other = copy.copy(world)
        other.set_force(body)
        world.step(0.25, steps=4)
        other.step(0.25, steps=4)
        self.assertEqual((world.v[body].tolist(), world.omega[body].tolist()), ([4, 0, 0], [0, 0, 0.5]))
        self.assertEqual((other.v[body].tolist(), other.omega[body].tolist()), ([0, 0, 0], [0, 0, 0]))
        world.set_force(body)
        world.step(0.25)
        self.assertEqual(world.v[body, 0], 4)
        points = falling(2)
        points.set_force(1, (0, 0, 10))  # the weight of 1 kg
        points.step(0.25, steps=8)
        self.assertEqual(points.v[:, 2].tolist(), [-20, 0])

    def test_bodies_can_be_put_elsewhere_and_what_is_left_out_stays(self):
        world = spook.World(gravity=(0, 0, 0))
        body = world.add(x=(1, 2, 3), v=(4, 5, 6), principal=(1, 1, 1), omega=(0, 0, 1))
        x = world.x  # numbers change in their place
        world.place(body, v=(0, 0, 0))
        self.assertEqual((x[body].tolist(), world.v[body].tolist()), ([1, 2, 3], [0, 0, 0]))
        world.place(body, x=(7, 8, 9))
        world.turn(body, q=(0, 1, 0, 0))
        self.assertEqual((x[body].tolist(), world.omega[body].tolist()), ([7, 8, 9], [0, 0, 1]))
        world.turn(body, omega=(0, 2, 0))
        self.assertEqual((world.q[body].tolist(), world.omega[body].tolist()), ([0, 1, 0, 0], [0, 2, 0]))

    def test_velocities_are_there_beside_the_positions_too(self):
        world = falling()
        world.start_half_step_back(0.25)
        world.step(0.25, steps=4)
        self.assertEqual(world.synchronized_velocity(0, 0.25).tolist(), [0, 0, -10])
        self.assertEqual(world.x[0, 2], -5)

    def test_a_copy_shares_nothing(self):
        world = falling()
        for other in (copy.copy(world), copy.deepcopy(world)):
            other.step(0.1)
            self.assertEqual((world.steps, world.x[0, 2]), (0, 0))

    def test_a_blowup_is_said_and_is_no_value_error(self):
        world = spook.PointWorld(gravity=(0, 0, -1e308))
        world.add()
        with self.assertRaisesRegex(spook.SimulationDiverged, r"blew up in step \d+ .*body 0 is not finite"):
            world.step(1, steps=10)

    def test_what_makes_no_sense_is_refused_in_the_engines_words(self):
        world = falling()
        self.refused("mass must be positive and finite, but is -1", world.add, mass=-1)
        self.refused("h must be positive and finite, but is 0", world.step, 0)
        self.refused("steps must be at least 0, but is -1", world.step, 0.1, steps=-1)
        self.refused("k must be positive and finite, but is nan", spook.World, k=math.nan)
        self.refused('unknown solver "dirct"; did you mean "direct"?', spook.World, solver="dirct")
        self.refused("iterations must be at least 1, but is 0", spook.World, iterations=0)
        self.refused("force must be finite, but is nan", world.set_force, 0, (0, 0, math.nan))
        self.refused("body must be an index below 1, but is 1", world.set_force, 1, (0, 0, 0))
        floor = world.add_plane()
        self.refused(f"body {floor} is static: no force moves it", world.set_force, floor, (0, 0, 1))
        self.refused("x must be finite, but is inf", world.place, 0, x=(0, 0, math.inf))
        self.refused("threshold must be left out without a restitution of the world, which may be 0, but is 0.5", spook.World,
                     threshold=0.5)
        spook.World(threshold=0.5, restitution=0)

    def test_an_argument_of_a_joint_is_named(self):
        for kind, of_kind in ((spook.World, ("add_joint", "add_rope", "add_hinge", "add_slider", "add_weld")),
                              (spook.PointWorld, ("add_joint", "add_rope"))):
            world = kind()
            world.add_fixed((0, 0, 0))
            world.add(x=(1, 0, 0), radius=0.1)
            for add in of_kind:
                length = {"length": 2} if add == "add_rope" else {}
                self.refused("joint's i must be an index below 2, but is 7", getattr(world, add), 7, 1, **length)
                self.refused("joint's j must be an index below 2, but is -1", getattr(world, add), 0, -1, **length)
        world = spook.World()
        nail, ball = world.add_fixed((0, 0, 0)), world.add(x=(1, 0, 0), radius=0.1)
        for add in (world.add_hinge, world.add_slider):
            self.refused("limits must be two numbers, the lower one first, but are 1 and 0", add, nail, ball, limits=(1, 0))
            self.refused("limits must be two numbers, the lower one first, but are 1 and 1; use a weld to lock a joint", add,
                         nail, ball, limits=(1, 1))
        world.add_hinge(nail, ball)
        joint = world.add_joint(nail, ball)
        for ask in (world.joint_position, world.joint_speed, world.motor_force, world.limit_force, world.spring_force,
                    lambda joint: world.set_motor(joint, (1, 1)), lambda joint: world.set_spring(joint, (1, 1))):
            self.refused("joint 1 must be a hinge or slider, but is of kind ball", ask, joint)


def box_on_plane():
    world = spook.World(friction=0.5)
    world.add_plane()
    world.add(x=(0, 0, 0.1), mass=2, half_sides=(0.3, 0.2, 0.1))
    return world


class Arrays(WithModule):
    def test_they_are_the_engines_numbers_and_can_only_be_read(self):
        world = falling()
        x = world.x
        world.step(0.5)
        self.assertEqual(x[0, 2], world.x[0, 2])
        self.assertEqual(x.__array_interface__["data"], world.x.__array_interface__["data"])
        with self.assertRaisesRegex(ValueError, "read-only"):
            x[0, 2] = 1

    def test_they_keep_the_world_alive(self):
        world = falling(1000)
        world.step(0.5)
        kept, same = world.v[::2].T, world.v.copy()
        del world
        gc.collect()
        filler = [falling(1000) for _ in range(20)]  # what would take freed memory
        np.testing.assert_array_equal(kept.T, same[::2])
        del filler

    def test_no_body_is_added_while_there_is_one(self):
        world = box_on_plane()
        part = world.omega[1:]
        for add in (world.add, world.add_plane, lambda: world.add_fixed((0, 0, 0))):
            with self.assertRaisesRegex(BufferError, "arrays that look at the bodies"):
                add()
        self.assertEqual(len(world), 2)
        del part
        world.add_fixed((0, 0, 9))
        self.assertEqual(world.x.shape, (3, 3))

    def test_an_empty_world_has_empty_ones(self):
        world = spook.World()
        self.assertEqual([world.x.shape, world.v.shape, world.omega.shape, world.q.shape],
                         [(0, 3), (0, 3), (0, 3), (0, 4)])
        world.add(radius=1)

    def test_velocities_are_of_their_bodies_and_orientations_begin_with_w(self):
        world = spook.World()
        world.add(radius=1, v=(1, 2, 3), omega=(4, 5, 6), q=(0.5, -0.5, 0.5, -0.5))
        world.add(radius=1, v=(7, 8, 9))
        np.testing.assert_array_equal(world.v, [[1, 2, 3], [7, 8, 9]])
        np.testing.assert_array_equal(world.omega, [[4, 5, 6], [0, 0, 0]])
        np.testing.assert_array_equal(world.q, [[0.5, -0.5, 0.5, -0.5], [1, 0, 0, 0]])


class Scenes(WithModule):
    def test_a_run_is_that_of_the_program(self):
        run = spook.scene("stack", bodies=4, ratio=100).run(h="1/60", time=1, solver="direct")
        self.assertEqual((run.steps, run.h, run.solver, run.state), (60, 1 / 60, "direct", "sound"))
        self.assertEqual(run["time"].shape, (61,))
        # -N/k, N the weight of all above, and the scene's error is the largest difference from it over the first.
        gaps = [run[f"gap {k} [m]"][-1] for k in range(4)]
        weights = 9.81 * np.array([103, 102, 101, 100])
        self.assertAlmostEqual(run.error, max(abs(gaps + weights / 1e6)) / (weights[0] / 1e6), delta=1e-12)
        with self.assertRaisesRegex(KeyError, "no column; there are: time"):
            run["gap 9"]
        self.assertEqual((run["residual"].shape, run["residual"][-1]), ((61,), run.residual))
        swept = spook.scene("stack").run(time=0.1, solver="gauss_seidel")
        self.assertGreater(swept["residual"][1:].min(), 0)
        with self.assertRaises(KeyError):  # a scene without rows has none
            spook.scene("orbit").run(time=0.1)["residual"]

    def test_a_step_may_be_a_number_a_fraction_or_a_text(self):
        from fractions import Fraction
        scene = spook.scene("orbit")
        errors = {scene.run(h=h, time=1).error for h in (1 / 64, Fraction(1, 64), "1/64", np.float64(1 / 64))}
        self.assertEqual(len(errors), 1)

    def test_all_scenes_and_solvers_are_there(self):
        self.assertLessEqual({"stack", "orbit", "tower", "wire"}, set(spook.scenes()))
        for name in spook.scenes():
            self.assertTrue(spook.scene(name).about["answer"])
        self.assertLessEqual({"gauss_seidel", "direct", "auto"}, set(spook.solvers()))

    def test_what_makes_no_sense_is_refused_in_the_programs_words(self):
        stack = spook.scene("stack")
        self.refused('unknown scene "stak"; did you mean "stack"?', spook.scene, "stak")
        self.refused('unknown parameter "bodis"; did you mean "bodies"?', spook.scene, "stack", bodis=3)
        self.refused('h must be a finite number such as 0.02, 1e6 or 1/60, but is "x"', stack.run, h="x")
        self.refused('unknown solver "dirct"; did you mean "direct"?', stack.run, solver="dirct")
        self.refused('unknown option "sovler"; did you mean "solver"?', stack.run_with, {"sovler": "direct"})
        with self.assertRaisesRegex(ValueError, "ratio must be"):
            spook.scene("stack", ratio=-1)

    def test_other_threads_go_on_during_a_run(self):
        stack, done = spook.scene("stack", bodies=50), []
        running = threading.Thread(target=lambda: done.append(stack.run(iterations=200)))
        running.start()
        counted = 0
        while running.is_alive():
            counted += 1
        running.join()
        self.assertEqual(len(done), 1)
        self.assertGreater(counted, 1000)  # a run that kept the others out would leave a few


class Arguments(WithModule):
    """A wrong argument gives one line: the argument, the accepted kind, the given value."""

    def told(self, what: str, call, *arguments, **named) -> None:
        with self.assertRaises(TypeError) as caught:
            call(*arguments, **named)
        self.assertEqual(str(caught.exception), what)

    def test_the_number_of_numbers(self):
        world = spook.World()
        self.told("add: half_sides: three numbers, got 2", world.add, half_sides=(1, 2))
        self.told("add: q: four numbers, got 3", world.add, q=(1, 0, 0))
        self.told("add: corners: rows of three numbers, got 1 x 2", world.add, corners=[(1, 2)])
        self.told("place: x: three numbers, got 4", world.place, 0, x=(1, 2, 3, 4))
        self.told("add_hinge: limits: two numbers, got 3", world.add_hinge, 0, 1, limits=(1, 2, 3))
        self.told("set_force: force: three numbers, got the number 3", world.set_force, 0, 3)

    def test_the_kind(self):
        world = spook.PointWorld()
        self.told("add: mass: a number, got 'heavy'", world.add, mass="heavy")
        self.told("add_joint: i: a whole number, got 0.5", world.add_joint, 0.5, 1)
        self.told("PointWorld: solver: a text, got 3", spook.PointWorld, solver=3)
        self.told("place: body: a whole number, got None", world.place, None)

    def test_what_only_looks_like_the_kind(self):
        world = spook.World()
        self.told("add: mass: a number, got '2'", world.add, mass="2")
        self.told("add: numbers, got ('0', '0', '5')", world.add, x=("0", "0", "5"))
        self.told("World: warm_start: True or False, got 'yes'", spook.World, warm_start="yes")
        self.told("World: iterations: a whole number that is not so large, got 1000000000000", spook.World, iterations=10**12)
        self.told("place: body: a whole number that is not so large, got 1099511627776", world.place, 2**40)
        self.told("exclude_contacts: bodies: a list of whole numbers, got 1", world.exclude_contacts, 1)
        self.told("add_slider: spring: a list of numbers, got 50", world.add_slider, 0, 1, spring=50)
        self.told("set_velocity_function: v: a function, got 5", world.set_velocity_function, 2, 5)
        self.told("set_state: state: bytes, got 'abc'", world.set_state, "abc")
        self.told("restore: saved: a World, got None", world.restore, None)
        self.told(f"restore: saved: a World, got {spook.PointWorld()!r}", world.restore, spook.PointWorld())
        self.told("scene: name: a text, got 3", spook.scene, 3)

    def test_of_a_step(self):
        world = spook.World()
        self.told("step: h is missing", world.step)
        self.told("step: h: a number, got '1/60'", world.step, "1/60")
        self.told("step: there is no dt; there are: h, steps", lambda: world.step(dt=0.1))
        self.told("step: steps: a whole number, got 1.5", world.step, 0.1, 1.5)
        self.told("step: steps: a whole number, got 'x'", lambda: world.step(0.1, steps="x"))
        self.told("step: at most 2 arguments without a name, got 3", world.step, 0.1, 1, 2)
        self.assertEqual(world.steps, 0)
        self.assertRegex(spook.World.step.__doc__, r"^step\(h: float, steps: int = 1\) -> None\n\nAdvances")

    def test_without_numpy_its_name_is_the_last_line(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "numpy.py").write_text("raise ModuleNotFoundError(\"No module named 'numpy'\")")
            done = subprocess.run([sys.executable, "-c", "import spook"], capture_output=True, text=True,
                                  env=os.environ | {"PYTHONPATH": f"{folder}:{SITE}"})
        self.assertIn("No module named 'numpy'", done.stderr.splitlines()[-1])

    def test_names(self):
        self.told("add: there is no half_side; did you mean half_sides?", spook.World().add, half_side=(1, 2, 3))
        self.told("World: there is no frictoin; did you mean friction?", spook.World, frictoin=1)
        self.told("add_joint: j is missing", spook.World().add_joint, 0)
        self.told("add: takes arguments by name, such as x=..., but got 1 without", spook.World().add, (1, 2, 3))
        self.told("run: there is no sovler; did you mean solver?", spook.scene("stack").run, sovler="direct")

    def test_a_call_that_is_right_is_as_before(self):
        world = spook.World(friction=0.5)
        self.assertEqual(world.add(x=(1, 2, 3), half_sides=np.array([1, 2, 3])), 0)
        self.assertEqual(world.add_fixed([0, 0, 0], radius=1), 1)
        self.refused("body must be an index below 2, but is 7", world.place, 7, x=(0, 0, 0))


class SoftSteps(WithModule):
    def tower(self, **settings):
        world = spook.World(friction=0.5, **settings)
        world.add_plane()
        for k in range(5):
            world.add(x=(0, 0, 0.1 + 0.2 * k), half_sides=(0.1, 0.1, 0.1))
        world.step(1 / 60, steps=60)
        return world

    def test_a_tower_stands(self):
        soft = self.tower(soft_steps=4)
        self.assertNotEqual(soft.state, "lost", soft.reason)
        # Each of the five contacts sags by at most a hundredth of a cube.
        np.testing.assert_allclose(soft.x[1:], self.tower().x[1:], atol=5 * 0.01 * 0.2)
        self.assertGreater(np.abs(soft.x - self.tower(soft_steps=16).x).max(), 0)

    def test_without_a_k(self):
        self.refused("k must be left out with soft_steps, whose springs follow from frequencies, but is 1000",
                     spook.World, k=1000, soft_steps=4)
        self.refused("soft_steps must be from 1 to 1024, but is 0", spook.PointWorld, soft_steps=0)
        for kind, of_kind in ((spook.World, ("add_joint", "add_hinge", "add_slider", "add_weld")), (spook.PointWorld, ("add_joint",))):
            world = kind(soft_steps=4)
            nail, ball = world.add_fixed((0, 0, 0)), world.add(x=(1, 0, 0), radius=0.1)
            for add in of_kind:
                rule = "must be left out with soft_steps, unless the joint has a k, but is 3"
                self.refused(f"d {rule}", getattr(world, add), nail, ball, d=3)
                if add != "add_joint":
                    self.refused(f"k_turn {rule}", getattr(world, add), nail, ball, k_turn=3)
                getattr(world, add)(nail, ball, k=1e3, d=3)

    def test_accuracy(self):
        np.testing.assert_allclose(self.tower(accuracy=1e-9).x, self.tower().x, atol=1e-6)
        self.refused("accuracy must be between 0 and 1, as a share of the right-hand side, but is 2", spook.World,
                     accuracy=2)
        for given in ({"solver": "direct"}, {"iterations": 9}, {"tolerance": 1e-3}, {"friction_model": "box"},
                      {"warm_start": True}, {"max_parts": 1}):
            self.refused("solver, friction_model, iterations, tolerance, warm_start and max_parts have no effect with "
                         "soft_steps: leave them out", spook.World, soft_steps=4, **given)
        self.refused("accuracy has no effect with soft_steps: leave one of them out", spook.World, accuracy=1e-3,
                     soft_steps=4)
        self.refused("solver must be one that has an accuracy, auto, geometric_stiffness, but is direct", spook.PointWorld,
                     accuracy=1e-3, solver="direct")
        spook.PointWorld(accuracy=1e-3, solver="geometric_stiffness")
        self.assertEqual(spook.scene("stack").run(accuracy=0.01).options, {"accuracy": 0.01})


def built_by_name(self, name):
    spook.World.__init__(self, friction=0.1)
    self.name = name
    self.add_plane()


class SavedWorlds(WithModule):
    def test_a_restored_world_goes_on_with_the_same_bits(self):
        world = spook.World(friction=0.5, warm_start=True, solver="gauss_seidel", iterations=5)
        world.add_plane()
        for k in range(4):
            world.add(x=(0.01 * k, 0, 0.1 + 0.2 * k), half_sides=(0.1, 0.1, 0.1))
        world.step(1 / 60, steps=20)
        saved = world.save()
        world.step(1 / 60, steps=20)
        first = world.x.copy(), world.q, world.time, world.steps
        world.restore(saved)
        self.assertEqual((world.time, world.steps), (saved.time, saved.steps))
        world.step(1 / 60, steps=20)
        np.testing.assert_array_equal(world.x, first[0])
        np.testing.assert_array_equal(world.q, first[1])
        self.assertEqual((world.time, world.steps), first[2:])

    def test_a_state_goes_on_with_the_same_bits_in_another_process(self):
        build = textwrap.dedent("""
            import sys, numpy as np, spook
            world = spook.World(friction=0.5)
            world.add_plane()
            for k in range(4):
                world.add(x=(0.01 * k, 0, 0.1 + 0.25 * k), half_sides=(0.1, 0.1, 0.1))
            """)
        go_on = build + textwrap.dedent("""
            world.set_state(sys.stdin.buffer.read())
            world.step(1 / 60, steps=30)
            print(world.time, world.state, *(float(number).hex() for number in world.x.ravel()))
            """)
        local = {}
        exec(build + "world.step(1 / 60, steps=50)", local)  # noqa: S102
        world = local["world"]
        done = subprocess.run([sys.executable, "-c", go_on], input=world.get_state(), capture_output=True, timeout=300,
                              env=os.environ | {"PYTHONPATH": str(SITE)})
        self.assertEqual(done.returncode, 0, done.stderr)
        world.step(1 / 60, steps=30)
        self.assertEqual(done.stdout.decode().split(),
                         [str(world.time), world.state, *(float(number).hex() for number in world.x.ravel())])

    def world_with_all(self, **settings):
        """Returns a world with contacts, each kind of joint and of shape, materials, forces and bodies that move along
        keyframes, some of it added after a number of steps."""
        world = spook.World(friction=0.5, gravity=np.array((0, 0, -9.81)), **settings)
        floor, gone = world.add_plane(), world.add(x=(9, 9, 9), radius=0.3)
        boxes = [world.add(x=(0.01 * k, 0, 0.1 + 0.21 * k), half_sides=(0.1, 0.1, 0.1), mass=1 + 0.1 * k) for k in range(3)]
        nail = last = world.add_fixed((2, 0, 3))
        for k in range(3):
            link = world.add(x=(2.3 + 0.3 * k, 0, 3), q=(math.cos(0.1 * k), math.sin(0.1 * k), 0, 0), radius=0.05, half_length=0.1)
            world.add_joint(last, link, (0.1 if k else 0, 0, 0), (-0.2, 0, 0))
            world.exclude_contacts([last, link, gone])
            last = link
        world.add(x=(5, 5, 1), corners=[(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0.3)], principal=(1, 1, 1.5))
        world.set_material(boxes[0], friction=0.1, restitution=0.3)
        world.set_material(boxes[1], floor, friction=0.9)
        world.step(1 / 60, steps=10)
        door = world.add(x=(-3, 0, 1), half_sides=(0.5, 0.05, 1))
        soft = "soft_steps" in settings
        world.add_hinge(nail, door, (-4.5, 0, -2), (0.5, 0, 0), axis=(0, 1 / 3, math.sqrt(8) / 3), limits=(-2, 2), motor=(0.5, 3),
                        spring=None if soft else (5, 0.1, 0.2))
        world.add_weld(last, world.add(x=(3.4, 0, 3), radius=0.1))
        if not soft:
            world.add_rope(nail, boxes[2], 4.0)
        lift, belt = world.add_fixed((-5, 0, 0), half_sides=(1, 1, 0.1)), world.add_fixed((8, 0, 0), half_sides=(1, 1, 0.1))
        world.set_keyframes(lift, [0, 1, 2], [(-5, 0, 0), (-5, 0, 1), (-5, 1 / 3, 1)])
        world.set_surface_velocity(belt, (0.3, 0, 0))
        world.add(x=(8, 0, 0.2), radius=0.1)
        world.set_force(boxes[2], (0.1, 0.2, 0.3), torque=(0, 0, 0.1))
        world.remove_body(gone)
        world.step(1 / 60, steps=10)
        return world

    def test_a_pickled_world_goes_on_with_the_same_bits(self):
        for settings in ({}, {"warm_start": True, "solver": "gauss_seidel"}, {"soft_steps": 4},
                         {"restitution": 0.5, "threshold": 0.1, "rotation": "exponential", "check": False},
                         {"k": 1e5, "d": 4.0, "max_parts": 4}):
            with self.subTest(settings), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                world = self.world_with_all(**settings)
                other = pickle.loads(pickle.dumps(world))
                third = copy.deepcopy(pickle.loads(pickle.dumps(other)))
                for each in (world, other, third):
                    each.step(1 / 60, steps=30)
                for each in (other, third):
                    for array in ("x", "v", "q", "omega", "masses"):
                        np.testing.assert_array_equal(getattr(world, array), getattr(each, array))
                    self.assertEqual((world.energy, world.state, world.time, world.report()),
                                     (each.energy, each.state, each.time, each.report()))
        points = falling(2)
        points.add_joint(points.add_fixed((0, 0, 1)), 0, length=1)
        points.set_force(1, (0, 1, 0))
        points.step(0.01)
        other = pickle.loads(pickle.dumps(points))
        points.step(0.01, steps=20)
        other.step(0.01, steps=20)
        np.testing.assert_array_equal(points.x, other.x)
        self.assertEqual(len(pickle.loads(pickle.dumps(spook.World()))), 0)

    def test_a_class_of_ones_own_is_pickled_with_its_attributes(self):
        with mock.patch.dict(globals(), {"Own": type("Own", (spook.World,), {"__module__": __name__, "__init__": built_by_name})}):
            world = Own("a name")  # noqa: F821
            other = pickle.loads(pickle.dumps(world))
        self.assertEqual((type(other), other.name, len(other)), (type(world), "a name", 1))

    def test_what_cannot_be_pickled_is_told(self):
        world = spook.World()
        world.add_plane()
        world.set_velocity_function(world.add_fixed((0, 0, 0)), lambda t: (0, 0, 1))
        with self.assertRaisesRegex(TypeError, "^a world cannot be pickled with a velocity function, but body 1 has one; "):
            pickle.dumps(world)
        world = falling()
        world.place(0, v=(1e308, 0, 0))
        with contextlib.suppress(spook.SimulationDiverged):
            world.step(10, steps=2)
        with self.assertRaisesRegex(TypeError, "no longer finite"):
            pickle.dumps(world)

    def test_a_state_of_another_world_is_refused_and_changes_nothing(self):
        world, other = falling(), falling()
        other.add(x=(5, 0, 0))
        world.step(0.25)
        state, x = world.get_state(), world.x.copy()
        seen = world.x  # stays where it is in memory
        for wrong in (other.get_state(), b"", state[:-1], state + b"x", b"\xff" * 1000,
                      *(state[:k] + b"\xff" * 8 + state[k + 8:] for k in range(0, len(state) - 8, 8))):
            with self.assertRaises(ValueError):
                world.set_state(wrong)
            np.testing.assert_array_equal(seen, x)
        world.set_state(state)
        with self.assertRaises(TypeError):
            world.set_state("text")

    def test_it_has_the_bodies_forces_and_verdict_of_then(self):
        world = falling()
        world.set_force(0, (0, 0, 10))  # its weight
        saved = world.save()
        world.add(x=(5, 0, 0))
        world.set_force(0, (0, 0, 0))
        world.place(0, x=(1e308, 0, 0), v=(1e308, 0, 0))
        with self.assertRaises(spook.SimulationDiverged):
            world.step(1e10)
        world.restore(saved)
        self.assertEqual((len(world), world.state, world.reason), (1, "sound", ""))
        world.step(0.25, steps=4)
        np.testing.assert_array_equal(world.x, [[0, 0, 0]])

    def test_arrays_that_look_at_the_bodies_keep_it_from_changing(self):
        world = falling()
        saved, x = world.save(), world.x
        with self.assertRaises(BufferError):
            world.restore(saved)
        del x
        world.restore(saved)
        world.restore(world)
        self.assertEqual(len(world), 1)


class Rows(WithModule):
    def test_all_bodies_are_placed_as_one_by_one(self):
        one, all_at_once = (self.mixed() for _ in range(2))
        draws = np.random.default_rng(1)
        x = draws.normal(size=(3, 3))
        v = draws.normal(size=(3, 3))
        q = draws.normal(size=(3, 4))
        q /= np.linalg.norm(q, axis=1)[:, None]
        omega = draws.normal(size=(3, 3))
        for body in (0, 2):
            one.place(body, x=x[body], v=v[body])
            one.turn(body, q=q[body], omega=omega[body])
        all_at_once.place_all(x=x, v=v)
        all_at_once.turn_all(q=q, omega=omega)
        for name in ("x", "v", "q", "omega"):
            np.testing.assert_array_equal(getattr(one, name), getattr(all_at_once, name), err_msg=name)
        all_at_once.place_all(x=2 * x)
        np.testing.assert_array_equal(all_at_once.v, one.v)

    def mixed(self):
        world = spook.World()
        world.add(x=(1, 0, 0), principal=(1, 2, 2))
        world.add_fixed((0, 1, 0))
        world.add(x=(0, 0, 1), principal=(1, 2, 2))
        return world

    def test_what_is_refused_changes_nothing(self):
        world = self.mixed()
        x, q = world.x.copy(), world.q
        self.refused("x must have a row for each of 3 bodies, but has 2", world.place_all, x=np.zeros((2, 3)))
        self.refused("v must be finite", world.place_all, x=np.ones((3, 3)), v=np.full((3, 3), np.nan))
        with self.assertRaisesRegex(ValueError, "q must "):
            world.turn_all(q=[(0, 1, 0, 0), (1, 0, 0, 0), (0, 0, 0, 0)])
        np.testing.assert_array_equal(world.x, x)
        np.testing.assert_array_equal(world.q, q)

    def test_joints_have_positions_and_speeds_in_one_array(self):
        world = spook.World(gravity=(0, 0, 0))
        fixed = world.add_fixed((0, 0, 0))
        wheel, cart = (world.add(x=(x, 0, 0), principal=(1, 2, 2)) for x in (0, 1))
        hinge = world.add_hinge(fixed, wheel, axis=(1, 0, 0), motor=(0.5, 3))
        world.add_joint(fixed, cart, length=1)
        slider = world.add_slider(wheel, cart, axis=(1, 0, 0))
        world.step(0.01, steps=10)
        joints = world.joints()
        for joint in (hinge, slider):
            self.assertEqual(joints["position"][joint], world.joint_position(joint))
            self.assertEqual(joints["speed"][joint], world.joint_speed(joint))
        self.assertTrue(np.isnan(joints["position"][1]) and np.isnan(joints["speed"][1]))


class Sweeps(WithModule):
    def test_orders_are_observed_between_rows_that_differ_in_h_only(self):
        table = spook.sweep(spook.scene("orbit"), start=["half_step", "unshifted"], h=["1/120", "1/240", "1/480"])
        self.assertEqual(len(table), 6)
        # Errors are C h^p (1 + O(h)): within a few hundredths at these steps.
        for start, order in (("half_step", 2), ("unshifted", 1)):
            rows = table.where(start=start)
            self.assertTrue(math.isnan(rows.rows[0]["order"]))
            np.testing.assert_allclose(rows["order"][1:], order, atol=0.05)
            np.testing.assert_array_equal(rows["h"], [1 / 120, 1 / 240, 1 / 480])
            (fit,) = table.fits().where(start=start)
            self.assertAlmostEqual(fit["order"], order, delta=0.05)
            self.assertEqual(fit["runs"], 3)

    def test_a_row_is_what_the_run_alone_says(self):
        stack = spook.scene("stack", bodies=5)
        table = spook.sweep(stack, solver=["gauss_seidel", "direct"], ratio=[1, 1000], iterations=20, time=1)
        for row in table:
            alone = spook.scene("stack", bodies=5, ratio=row["ratio"]).run(solver=row["solver"], iterations=20, time=1)
            self.assertEqual((row["error"], row["state"], row["row_updates"]),
                             (alone.error, alone.state, alone.row_updates))

    def test_what_makes_no_sense_is_refused_before_anything_runs(self):
        with mock.patch("spook._spook.run") as run:
            self.refused('solver=dirct is refused in every combination: unknown solver "dirct"; did you mean "direct"?',
                         spook.sweep, spook.scene("stack"), solver=["direct", "dirct"])
            self.refused("jobs must be at least 1, but is 0", spook.sweep, spook.scene("stack"), jobs=0)
            self.refused("ratio must have at least one value, but the list is empty", spook.sweep, "stack", ratio=[])
        run.assert_not_called()

    def test_combinations_that_are_refused_are_skipped(self):
        table = spook.sweep(spook.scene("stack"), solver=["direct", "gauss_seidel"], row_order=["given", "random"], time=0.1)
        self.assertEqual(len(table), 3)
        (skipped,) = table.skipped
        self.assertEqual((skipped["solver"], skipped["row_order"]), ("direct", "random"))
        self.assertIn("with a row order, solver must be gauss_seidel", skipped["why"])

    def test_a_parameter_goes_before_an_option_and_seeds_have_a_mean(self):
        table = spook.sweep(spook.scene("pile", bodies=5), seed=[1, 2, 3], time=0.1)
        for row in table:
            alone = spook.scene("pile", bodies=5, seed=row["seed"]).run(time=0.1)
            self.assertEqual((row["error"], row["row_updates"]), (alone.error, alone.row_updates))
        (mean,) = table.means().rows
        self.assertEqual((mean["runs"], mean["unsolved"], mean["lost"]), (3, 0, 0))
        self.assertAlmostEqual(mean["mean"], table["error"].mean(), delta=1e-12 * abs(table["error"]).max())
        with self.assertRaisesRegex(KeyError, "'h' is not swept"):
            table.means("h")

    def test_a_parameter_keeps_apart_from_a_result_of_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, column in (("error", "error="), ("steps", "steps="), ("why", "why="), ("mean", "mean"), ("runs", "runs")):
                file = Path(folder, "s.json")
                file.write_text(json.dumps({
                    "format": "spook scene", "version": 2, "model": "point", "h": 0.01, "time": 0.1, "half_step_start": True,
                    "parameters": {name: {"default": 1}}, "bodies": [{"x": [f"${name}", 0, 0], "mass": 1}],
                    "expected": [{"body": 0, "time": 0.1, "x": [0, 0, -0.04905], "tolerance": 1}]}))
                table = spook.sweep(str(file), h=[0.01, 0.005], progress=False, **{name: [3, 7]})
                np.testing.assert_array_equal(table[column], [3, 7, 3, 7])
                np.testing.assert_allclose(table["error"], [3, 7, 3, 7])
                self.assertEqual([mean["mean"] for mean in table.means("h")], [3, 7])
                self.assertEqual(len(table.where(**{column: 3})), 2)

    def test_orders_need_errors_above_round_off_and_one_end(self):
        for scene, h, options in (("cradle", ["1/100", "1/200", "1/400"], {}),
                                  ("free_fall", [0.3, 0.15, 0.07], {"start": "unshifted", "time": 1})):
            table = spook.sweep(scene, h=h, progress=False, **options)
            self.assertTrue(np.isnan(table["order"]).all())
            self.assertEqual(len(table.fits()), 0)

    def test_rows_are_found_by_what_was_typed(self):
        table = spook.sweep(spook.scene("orbit"), h=["1/60", "1/120"], time=1)
        for typed in ("1/60", 1 / 60, Fraction(1, 60)):
            self.assertEqual([row["h"] for row in table.where(h=typed)], [1 / 60])
        with self.assertRaisesRegex(KeyError, "'hh' is no column"):
            table.where(hh=1)

    def test_a_table_is_written_as_csv(self):
        table = spook.sweep(spook.scene("orbit"), h=["1/60", "1/120"], time=1)
        with tempfile.TemporaryDirectory() as folder:
            table.to_csv(Path(folder, "t.csv"))
            manifest = json.loads(Path(folder, "t.csv.manifest.json").read_text(encoding="utf-8"))
            rows = list(csv.DictReader(Path(folder, "t.csv").read_text(encoding="utf-8").splitlines()))
        self.assertEqual([float(row["error"]) for row in rows], list(table["error"]))
        self.assertEqual(manifest["command"], "spook.sweep(spook.scene('orbit'), h=['1/60', '1/120'], time=[1])")
        self.assertTrue(all(manifest.values()), manifest)
        self.assertEqual(len(manifest["sha256"]), 1)
        with mock.patch.dict(sys.modules, {"pyarrow": None}), self.assertRaises(ImportError) as caught:
            table.to_parquet("t.parquet")
        self.assertEqual(str(caught.exception),
                         '"t.parquet" needs the Python package pyarrow; pip install pyarrow, or write CSV')

    def test_a_run_that_blows_up_has_a_row_that_says_so(self):
        with mock.patch("spook._spook.run", side_effect=spook.SimulationDiverged("blew up in step 1")):
            table = spook.sweep(spook.scene("orbit"), h=[0.1, 0.2])
        self.assertEqual([row["state"] for row in table], ["blew up"] * 2)
        self.assertEqual([row["h"] for row in table], [0.1, 0.2])  # what was swept stays
        self.assertEqual((len(table.where(h="1/10")), table.rows[0]["why"]), (1, "blew up in step 1"))
        self.assertTrue(np.isnan(table["error"]).all() and np.isnan(table["order"]).all())

    def test_a_scene_may_be_a_name_and_other_names_are_told_with_the_nearest(self):
        with mock.patch("spook._spook.run") as run:
            self.refused("iteratons is neither a parameter of stack nor an option of run; did you mean iterations?",
                         spook.sweep, "stack", iteratons=[1, 2])
            with self.assertRaisesRegex(TypeError, "^sweep: scene: a Scene or a name, got 3$"):
                spook.sweep(3)
        run.assert_not_called()
        self.assertEqual(len(spook.sweep("orbit", h=[0.1], time=0.2)), 1)

    def test_rows_have_the_reason_and_the_note(self):
        run = spook.scene("tower", boxes=10, ratio=1000).run(iterations=2, time=0.5, solver="gauss_seidel")
        self.assertEqual(run.state, "unsolved")
        self.assertGreater(run.unsolved_steps, 0)
        (row,) = spook.sweep("tower", boxes=10, ratio=1000, iterations=2, time=0.5, solver="gauss_seidel")
        self.assertEqual((row["why"], row["note"], row["unsolved_steps"]), (run.reason, run.note, run.unsolved_steps))
        self.assertEqual(len({run, run}), 1)  # a run has a hash

    def test_it_is_a_table_to_look_at(self):
        table = spook.sweep(spook.scene("orbit"), h=["1/60"], time=1)
        self.assertNotIn("note", repr(table))
        self.assertIn("us_per_step", repr(table).splitlines()[0])
        self.assertIn("<th>error</th>", table._repr_html_())


class Films(WithModule):
    def setUp(self):
        if lacks := [need.package for need in VIEW_NEEDS if not need.there()]:
            self.skipTest(f"films need {' and '.join(lacks)}")

    def test_a_run_shows_its_film_in_a_notebook_and_as_a_page(self):
        run = spook.scene("pendulum").run(time=0.5)
        shown = run._repr_html_()
        self.assertTrue(shown.startswith('<iframe srcdoc="&lt;!DOCTYPE html'), shown[:100])
        self.assertTrue("data-recording=&quot;" in shown)
        with tempfile.TemporaryDirectory() as folder:
            page = Path(run.view(f"{folder}/film.html")).read_text()
        self.assertTrue('data-recording="' in page)

    def test_where_the_library_that_draws_it_is_missing_it_says_so(self):
        run = spook.scene("pendulum").run(time=0.5)
        with mock.patch("spook.scene.page", side_effect=RuntimeError("three.min.js is missing")):
            self.assertRegex(run._repr_html_(), "three.min.js is missing")

    def test_a_recording_has_a_header_its_frames_and_an_end(self):
        lines = [json.loads(line) for line in spook.scene("pendulum").record({"time": 0.5}, fps=20).splitlines()]
        self.assertEqual((lines[0]["format"], lines[0]["scene"]), ("spook recording", "pendulum"))
        self.assertEqual(len(lines), 1 + 11 + 1)  # a frame each 0.05 s, the start included

class Page(WithModule):
    def test_the_examples_of_the_page_run(self):
        page = (ROOT / "tools" / "python" / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.assertEqual(len(blocks), 3)
        with mock.patch("spook.Run.view"), contextlib.redirect_stdout(io.StringIO()) as said:
            exec("\n".join(blocks), {})
        self.assertRegex(said.getvalue(), r"(?s)^\[.* sound .*half_step")

    def test_the_example_draws_its_figure(self):
        example = ROOT / "tools" / "python" / "examples" / "work_precision.py"
        self.assertLessEqual(len(example.read_text().splitlines()), 36)
        with tempfile.TemporaryDirectory() as folder:
            env = os.environ | {"PYTHONPATH": str(SITE), "MPLBACKEND": "agg"}
            done = subprocess.run([sys.executable, example], cwd=folder, env=env, capture_output=True, text=True)
            self.assertTrue(Path(folder, "work_precision.png").exists(), done.stderr)


class Stub(WithModule):
    def test_it_has_all_names_there_are_with_their_arguments(self):
        module = sys.modules["spook._spook"]
        stub = {node.name: node for node in ast.parse(STUB.read_text()).body if hasattr(node, "name")}
        shared = functions(stub.pop("_EitherWorld"))
        self.assertEqual(set(stub), {name for name in vars(module) if not name.startswith("_")})
        for name in ("World", "PointWorld"):
            said = shared | functions(stub[name])
            has = {member for member in vars(getattr(module, name))
                   if not member.startswith("_") or member in ("__len__", "__copy__", "__deepcopy__", "__init__")}
            self.assertEqual(set(said), has)
            for member in has:
                if found := re.match(rf"{member}\((.*)\) -> ", getattr(module, name).__dict__[member].__doc__ or ""):
                    takes = re.findall(r"(?:^|, )(\w+)(?=:)", found[1])
                    self.assertEqual(takes[1:] if takes[:1] == ["self"] else takes, said[member], member)


def functions(node: ast.ClassDef) -> dict[str, list[str]]:
    return {item.name: [argument.arg for argument in item.args.args[1:] + item.args.kwonlyargs]
            for item in node.body if isinstance(item, ast.FunctionDef)}


class Installing(WithModule):
    def test_the_command_runs_a_file_with_the_module_to_import(self):
        done = subprocess.run([ROOT / "course", "python", "-c", "import spook; print(spook.World())"],
                              capture_output=True, text=True, env=os.environ)
        self.assertEqual(done.stdout.strip(), "<spook.World: 0 bodies, 0 joints, 0 s>", done.stderr)

    def test_a_wheel_holds_the_module_and_says_what_it_is(self):
        sys.path.insert(0, str(ROOT / "tools" / "python"))
        backend = importlib.import_module("backend")
        with tempfile.TemporaryDirectory() as folder:
            copied = mock.patch.object(backend, "_install", lambda to: subprocess.run(
                ["cp", "-r", f"{SITE}/.", to], check=True))
            with copied:
                wheel = Path(folder, backend.build_wheel(folder))
            self.assertRegex(wheel.name, r"^spook-1\.0\.0-cp3\d+-cp3\d+-linux_\w+\.whl$")
            with zipfile.ZipFile(wheel) as content:
                content.extractall(f"{folder}/there")
                recorded = content.read("spook-1.0.0.dist-info/RECORD").decode().splitlines()
                self.assertEqual(sorted(line.split(",")[0] for line in recorded), sorted(content.namelist()))
            code = "import spook; print(spook.__file__); spook.World().step(0.1)"
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=folder,
                                  env=os.environ | {"PYTHONPATH": f"{folder}/there"})
            self.assertIn(f"{folder}/there/spook", done.stdout, done.stderr)


if __name__ == "__main__":
    unittest.main()
