"""With any answer to a call, the tests neither pass wrongly nor break."""

import contextlib
import os
import random
import socket
import struct
import subprocess
import unittest

import sandbox  # noqa: F401

from grading.workshop import build_tests, listed_tests, test_program
from manifest import Chapter, all_exercises, read_chapters

BEGIN, BEGUN, CALL, RETURNED, THREW, FORCE_AT, END, ENDED = range(8)
SEED = 3
# Of every kind of thing that is sent: vectors, a force, structs, a generator, sparse matrices, factors.
EXERCISES = ("kick", "leapfrog_step", "match_contacts", "random_order", "box_box", "schur_complement", "factorise")


def chapter_of(function: str) -> Chapter:
    return next(chapter for chapter in read_chapters() if function in {one.function for one in chapter.exercises})


class Tests:
    """The program with the tests, and its socket."""

    def __init__(self, function: str):
        self.chapter = chapter_of(function)
        theirs, self.socket = socket.socketpair()
        read, write = os.pipe()
        os.set_inheritable(write, True)
        command = ["/bin/sh", "-c", f'exec "$0" "$1" 3<&{theirs.fileno()} 4>&{write}',
                   str(test_program(self.chapter)), function]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, pass_fds=(theirs.fileno(), write))
        theirs.close()
        os.close(write)
        self._report = os.fdopen(read, "rb")

    def close(self) -> None:
        self.socket.close()
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait(30)
        self._report.close()

    def send(self, kind: int, content: bytes = b"") -> None:
        self.socket.sendall(struct.pack("=IB", len(content), kind) + content)

    def receive(self) -> tuple[int, bytes]:
        length, kind = struct.unpack("=IB", self._exactly(5))
        return kind, self._exactly(length)

    def _exactly(self, count: int) -> bytes:
        found = b""
        while len(found) < count:
            more = self.socket.recv(count - len(found))
            if not more:
                raise ConnectionError
            found += more
        return found

    def run(self, test: str, answer) -> list[bytes]:
        """Returns the report of the test, when each call is answered by `answer`, which sends."""
        self.process.stdin.write(test.encode() + b"\n")
        self.process.stdin.flush()
        while self.receive()[0] != BEGIN:
            pass
        self.send(BEGUN)
        while True:
            try:
                kind, content = self.receive()
            except ConnectionError:  # it has ended, because of what it was sent
                break
            if kind == CALL:
                answer(self, content)
            if kind == END:
                self.send(ENDED, struct.pack("=ixxxxd", 0, 0.0))
                break
        return self._reported()

    def _reported(self) -> list[list[bytes]]:
        kinds = []
        while not kinds or kinds[-1][0] != b"done":
            kinds.append(self._report.read(int(self._report.readline())).split(b"\0"))
        return kinds


class Hostile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build_tests(read_chapters())

    def assert_none_passes(self, answer, functions=EXERCISES) -> None:
        for function in functions:
            suite = next(exercise.suite for exercise in all_exercises() if exercise.function == function)
            tests = Tests(function)
            with contextlib.closing(tests):
                for test in [one for one in listed_tests(tests.chapter) if one.startswith(f"{suite}.")][:6]:
                    said = []

                    def once(to, content):
                        said.append(len(content))
                        answer(to, content)
                    kinds = tests.run(test, once)
                    if said:  # a test that never calls the function says nothing of it
                        self.assertNotIn([b"verdict", b"0", b"1", b"", b""], kinds, f"{test} (seed {SEED})")
                    if [b"nonsense", b""] in kinds:
                        break  # the grader begins anew after it

    def test_noise(self):
        draw = random.Random(SEED)
        sizes = (0, 1, 7, 8, 24, 25, 32, 33, 100, 5000)
        self.assert_none_passes(lambda to, _: to.send(RETURNED, draw.randbytes(draw.choice(sizes))))

    def test_sizes_that_are_none(self):
        huge = struct.pack("=Q", 2**63)
        self.assert_none_passes(lambda to, _: to.send(RETURNED, bytes(8) + huge * 30))
        self.assert_none_passes(lambda to, _: to.send(THREW, struct.pack("=QiQ", 0, 99, 2**40)))

    def test_what_is_asked_comes_back(self):
        self.assert_none_passes(lambda to, content: to.send(RETURNED, content))
        self.assert_none_passes(lambda to, content: to.send(RETURNED, bytes(8) + content))
        self.assert_none_passes(lambda to, content: to.send(FORCE_AT, content))

    def test_its_own_messages_and_others(self):
        for kind in (BEGIN, BEGUN, CALL, END, 8, 200):
            self.assert_none_passes(lambda to, content, kind=kind: to.send(kind, content), ("kick", "leapfrog_step"))

    def test_it_goes_on_with_the_next(self):
        """Tests of one program do not know what became of each other."""
        draw = random.Random(SEED)
        tests = Tests("drift")
        with contextlib.closing(tests):
            noise = (lambda to, _: to.send(RETURNED, draw.randbytes(32)), False)
            for answer, passes in (noise, (self.drift, True)) * 3:
                kinds = tests.run("Drift.MovesByVelocityTimesStep", answer)
                self.assertEqual([b"verdict", b"0", b"1", b"", b""] in kinds, passes)

    @staticmethod
    def drift(to: Tests, content: bytes) -> None:
        values = struct.unpack("=i7d", content)
        operations = 12
        to.send(RETURNED, struct.pack("=Q3d", operations, *(values[k] + values[7] * values[k + 3] for k in (1, 2, 3))))


if __name__ == "__main__":
    unittest.main()
