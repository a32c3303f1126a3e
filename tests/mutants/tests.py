"""The tests that can notice a fault: those that enter its function, found once without a fault."""

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PACKAGES = "-p motion-lab-core -p motion-lab-sim -p motion-lab --no-default-features --features headless".split()
TESTS = [*PACKAGES, *"--lib --test core --test sim --test tests".split()]
# the programs that tests run and cargo does not build with them
BESIDE = [*PACKAGES, "--example", "own_program"]
# optimised, or the tests of the simulator take most of the day; with debug assertions, which notice faults of their own
BUILD = {"CARGO_TERM_COLOR": "never", "CARGO_INCREMENTAL": "0", "RUSTFLAGS": "--cap-lints allow"}
BUILD |= {"CARGO_PROFILE_DEV_OPT_LEVEL": "2", "CARGO_PROFILE_DEV_DEBUG": "0"}
# what a fault that allocates without end may take, bytes of address space
MEMORY = 12 << 30


def cargo(tree: Path, target: Path, *words: str) -> list[dict]:
    """What cargo says of a command, message by message."""
    command = ["nice", "-n", "19", "cargo", *words, "--message-format=json"]
    environment = {**os.environ, **BUILD, "CARGO_TARGET_DIR": str(target)}
    done = subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    messages = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode and not any(message["reason"] == "compiler-message" for message in messages):
        sys.exit(done.stderr)
    return messages


def errors(messages: list[dict]) -> list[dict]:
    """The compiler's errors among cargo's messages."""
    said = (message["message"] for message in messages if message["reason"] == "compiler-message")
    return [message for message in said if message["level"] == "error" and message["spans"]]


class Binary:
    """A program of tests."""

    def __init__(self, message: dict) -> None:
        self.path = message["executable"]
        self.package = str(Path(message["manifest_path"]).parent)
        self.name = message["target"]["name"]

    def tests(self) -> list[str]:
        """The names of its tests."""
        said = subprocess.check_output([self.path, "--list", "--format", "terse"], cwd=self.package, text=True)
        return [line.removesuffix(": test") for line in said.splitlines() if line.endswith(": test")]

    def run(self, names: list[str], most: float, **variables: str) -> tuple[str, str]:
        """What the tests say, and which of them: passed, failed or timeout."""
        command = ["nice", "-n", "19", self.path, "--exact", "--test-threads=1", *names]
        environment = {**os.environ, **variables, "CARGO_MANIFEST_DIR": self.package}
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        pipe, null = subprocess.PIPE, subprocess.DEVNULL
        tests = subprocess.Popen(
            command, cwd=self.package, env=environment, stdout=pipe, stderr=null, text=True, errors="replace", start_new_session=True, preexec_fn=limit
        )
        late = threading.Event()
        timer = threading.Timer(most, lambda: (late.set(), os.killpg(tests.pid, signal.SIGKILL)))
        timer.start()
        failed = last = ""
        for line in tests.stdout:
            if line.startswith("test "):
                last = line.split()[1]
                if line.rstrip().endswith("FAILED"):
                    failed = last
                    break
        if failed:
            os.killpg(tests.pid, signal.SIGKILL)
        code = tests.wait()
        timer.cancel()
        return ("failed", failed) if failed else ("timeout", last) if late.is_set() else ("failed", f"exit {code}") if code else ("passed", "")


class Suite:
    """All tests, with how long each takes and which functions with faults it enters."""

    def __init__(self, binaries: list[Binary], jobs: int) -> None:
        self.entered: dict[int, list[tuple[float, Binary, str]]] = {}
        every = [(binary, name) for binary in binaries for name in binary.tests()]
        failed = []

        def tried(test: tuple[Binary, str]) -> None:
            binary, name = test
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "entered"
                start = time.monotonic()
                said, _ = binary.run([name], 1800, MOTION_LAB_ENTERED=str(path))
                took = time.monotonic() - start
                if said != "passed":
                    failed.append(f"{binary.name} {name}: {said} without a fault")
                for function in {int(line) for line in path.read_text().splitlines()} if path.exists() else ():
                    self.entered.setdefault(function, []).append((took, binary, name))

        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(tried, every))
        if failed:
            sys.exit("\n".join(failed))
        self.count = len(every)

    def outcome(self, number: int, function: int, room: str) -> tuple[str, str]:
        """What the tests say of a fault, the nearest and the fastest first: killed, timeout or survived, and the test that noticed."""
        tests = sorted(self.entered.get(function, []), key=lambda test: (f"{room}::" not in test[2], test[0], test[2]))
        if not tests:
            return "survived", "entered by no test"
        for part in (tests[:6], tests[6:30], tests[30:]):
            for binary in dict.fromkeys(test[1] for test in part):
                mine = [test for test in part if test[1] is binary]
                said, which = binary.run([test[2] for test in mine], 30 + 6 * sum(test[0] for test in mine), MOTION_LAB_FAULT=str(number))
                if said != "passed":
                    return {"failed": "killed"}.get(said, said), f"{binary.name} {which}"
        return "survived", f"{len(tests)} tests"
