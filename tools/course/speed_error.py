"""Speed against error: the reference engine on scenes with known answers."""

import json
import subprocess
from dataclasses import dataclass
from fractions import Fraction

from errors import CourseError
from terminal import Live, paint


@dataclass(frozen=True)
class Case:
    scene: str
    settings: tuple[str, ...]  # name=value, as after --set
    steps: tuple[str, ...]  # h
    iterations: tuple[int, ...] = ()


STEPS = ("1/60", "1/120", "1/240")
CASES = (
    Case("free_fall", (), STEPS),
    Case("orbit", (), STEPS),
    Case("orbit", ("start=unshifted",), STEPS),
    Case("top", ("update=first_order",), STEPS),
    Case("top", ("update=splitting",), STEPS),
    Case("resting_sphere", (), STEPS),
    Case("stack", ("bodies=2", "ratio=1000"), ("1/60",), (10, 100, 1000, 10000)),
)


def measure(program: str) -> list[dict]:
    """Runs every case. Returns a list of outputs of `spook run --json`, each with the requested values as `asked`."""
    runs = [(case, h, count) for case in CASES for h in case.steps for count in case.iterations or (None,)]
    results = []
    live = Live("running")
    for k, (case, h, count) in enumerate(runs):
        live.update(f"{case.scene} [{k + 1}/{len(runs)}]")
        command = [program, "run", case.scene, "--h", h, "--json"]
        for setting in case.settings:
            command += ["--set", setting]
        asked = list(case.settings)
        if count is not None:
            command += ["--iterations", str(count)]
            asked.append(f"{count} its")
        results.append(_run(command) | {"asked": asked})
    live.done()
    return results


def _run(command: list[str]) -> dict:
    done = subprocess.run(command, capture_output=True, text=True)
    try:
        if done.returncode == 0:
            return json.loads(done.stdout)
    except ValueError:
        pass
    said = (done.stderr.strip() or "no JSON").splitlines()[-1]
    raise CourseError(f"{' '.join(command[1:])}: exit code {done.returncode}, {said}")


def show_table(results: list[dict]) -> None:
    print(paint(f"{'scene':<32} {'solver':<12} {'h [s]':>6} {'µs/step':>8}  error", "bold"))
    scene = None
    for result in results:
        error = result["error"]
        if result["scene"] != scene:
            scene = result["scene"]
            print(f"{scene}: {error['name']}"[:80])
        asked = " ".join(result["asked"])[:30]
        print(f"  {asked:<30} {result['solver'][:12]:<12} {_step(result['h']):>6} "
              f"{result['us_per_step']:>8.3g}  {_number(error['value'])} {error['unit']}".rstrip())


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.1e}"


def _step(h: float) -> str:
    """Returns a step as 1/60 rather than 0.016667 if it is exactly that."""
    fraction = Fraction(h).limit_denominator(100000)
    return str(fraction) if abs(float(fraction) - h) < 1e-12 and len(str(fraction)) <= 6 else f"{h:.4g}"
