"""queue_array.py SCRIPT LOG: runs the array of a script of `hq submit` by a HyperQueue of this machine with a worker of two cores.

PyPI's wheel holds HyperQueue as a library, not the program `hq`. So the array is read from the script: `--array 1-N` and what is
behind `--`. Tasks of the library are numbered from 0, where an array of a sweep begins at 1: task 0 does nothing. What each task
says goes to LOG-K.log. Exits with 1 if a task failed.
"""

import logging
import shlex
import sys
import tempfile
from pathlib import Path

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig

script, log = sys.argv[1:]
logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s", stream=sys.stdout)
with open(script) as text:
    words = shlex.split(text.read().split("exec ", 1)[1].replace("\\\n", " "))
first, last = words[words.index("--array") + 1].split("-")
crash_limit = int(words[words.index("--crash-limit") + 1])
command = words[words.index("--") + 1 :]
assert words[:2] == ["hq", "submit"] and first == "1", words
logging.info("%s tasks of %s", last, shlex.join(command))

with tempfile.TemporaryDirectory(dir=Path.cwd()) as folder, LocalCluster(folder, WorkerConfig(cores=2)) as cluster:
    client = cluster.client()
    # a task that failed is no reason to stop the others
    job = Job(max_fails=None, default_workdir=".")
    job.program(["true"])
    for k in range(1, int(last) + 1):
        job.program(command, stdout=f"{log}-{k}.out", stderr=f"{log}-{k}.log", crash_limit=crash_limit)
    submitted = client.submit(job)
    if not client.wait_for_jobs([submitted], raise_on_error=False):
        for task, failed in client.get_failed_tasks(submitted).items():
            logging.error("task %s: %s", task, failed.error)
        sys.exit(1)
logging.info("all tasks are done")
