#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A Slurm of its own on this machine runs scripts/slurm_array.sh, loses a task on the way, and merges.

    slurm.py PROGRAM [parts]

Must run as root: it installs Debian's slurmctld, slurmd, slurm-client and munge where they are missing, starts them in
a folder of their own with ports of their own, and stops them at the end."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

from kill_and_resume import STUDY, variables

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "slurm_array.sh"
PACKAGES = ["slurmctld", "slurmd", "slurm-client", "munge"]


def install():
    if all(shutil.which(name) for name in ("slurmctld", "slurmd", "sbatch", "munged")):
        return
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run(["apt-get", "update", "-qq"], check=True, env=environment)
    subprocess.run(["apt-get", "install", "-y", "-qq", "--no-install-recommends", *PACKAGES], check=True,
                   env=environment, stdout=subprocess.DEVNULL)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """munged, slurmctld and slurmd of one node, which is this machine."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []
        host = socket.gethostname().split(".")[0]
        controller, node = free_ports(2)
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir()
        (folder / "munge").chmod(0o711)
        (folder / "key").write_bytes(os.urandom(1024))
        (folder / "key").chmod(0o400)
        self.munge_socket = folder / "munge" / "socket"
        (folder / "slurm.conf").write_text(f"""\
ClusterName=millstudy
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={self.munge_socket}
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0
KillWait=2
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}

    def start(self):
        self.daemon("munged", "--foreground", "--force", f"--socket={self.munge_socket}",
                    f"--key-file={self.folder}/key", f"--pid-file={self.folder}/munged.pid",
                    f"--seed-file={self.folder}/seed", f"--log-file={self.folder}/munged.log")
        wait_until(self.munge_socket.exists, 10, "munged")
        self.daemon("slurmctld", "-D")
        self.daemon("slurmd", "-D")
        wait_until(lambda: "idle" in self.command("sinfo", "-h", "-o", "%T", check=False), 30, "slurmd")

    def daemon(self, *command):
        log = (self.folder / f"{command[0]}.out").open("w")
        program = shutil.which(command[0], path=os.environ["PATH"] + ":/usr/sbin")
        self.daemons.append(subprocess.Popen([program, *command[1:]], env=self.environment, stdout=log, stderr=log))

    def command(self, *command, check=True):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if check and done.returncode != 0:
            raise RuntimeError(f"{command}: {done.stdout}{done.stderr}")
        return done.stdout

    def queue(self):
        """[(job, state, restarts)]"""
        return [line.split() for line in self.command("squeue", "-h", "-r", "-o", "%i %T").splitlines()]

    def stop(self):
        self.command("scancel", "-u", "root", check=False)
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in self.daemons:
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def wait_until(true, seconds, what):
    deadline = time.monotonic() + seconds
    while not true():
        if time.monotonic() > deadline:
            raise RuntimeError(f"{what}: not within {seconds} s")
        time.sleep(0.1)


def tasks_of(parts, study):
    """Processes that compute a part: {part: process}."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().decode().split("\0")
        except (OSError, ValueError):
            continue
        if "run" in words and "--shard" in words and study in words:
            found[words[words.index("--shard") + 1].split("/")[0]] = int(entry.name)
    return found


def run(program, parts, folder):
    study, result = folder / "study.toml", folder / "R.h5"
    study.write_text(STUDY.replace("angular_steps = 360", "angular_steps = 14400"))
    subprocess.run([program, "run", study, "-o", folder / "alone.h5", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    expected = variables(folder / "alone.h5")
    cluster = Cluster(folder / "cluster")
    try:
        cluster.start()
        print(cluster.command("sinfo").strip())
        submit = [SCRIPT, study, str(parts), "-o", result, "-p", program]
        print(cluster.command(*submit).strip())
        # One task is killed, as by a node that fails; it is queued again by itself.
        wait_until(lambda: tasks_of(parts, str(study)), 60, "the first task")
        time.sleep(0.2)
        victim, process = next(iter(tasks_of(parts, str(study)).items()))
        os.kill(process, signal.SIGKILL)
        wait_until(lambda: not cluster.queue(), 400, "the array and the merge")
        log = (folder / f"R.shard-{victim}-of-{parts}.log").read_text()
        if "it is queued again" not in log:
            raise RuntimeError(f"the killed part {victim} was not queued again: {log}")
        if variables(result) != expected:
            raise RuntimeError("the merged variables differ")
        print(f"{parts} parts, part {victim} killed and queued again: merged, bit for bit that of one process")
        # A part that is lost for good: merge says what is missing, the same command again computes it.
        result.unlink()
        (folder / f"R.shard-1-of-{parts}.h5").unlink()
        cluster.command(program, "merge", result, *sorted(folder.glob("R.shard-*.h5")), check=False)
        if result.exists():
            raise RuntimeError("merge made a result of which a part is missing")
        print(cluster.command(*submit).strip())
        wait_until(lambda: not cluster.queue(), 400, "the missing part and the merge")
        if variables(result) != expected:
            raise RuntimeError("the variables differ after a lost part")
        print("a lost part: computed again by the same command, merged, bit for bit")
        # Who cancels the array does not want it queued again; the journal stays.
        (folder / f"R.shard-2-of-{parts}.h5").unlink()
        result.unlink()
        cluster.command(*submit)
        wait_until(lambda: tasks_of(parts, str(study)), 60, "the task to cancel")
        time.sleep(1.5)
        cluster.command("scancel", "-u", "root")
        wait_until(lambda: not cluster.queue(), 60, "the end of what was cancelled")
        time.sleep(3)
        if cluster.queue() or result.exists():
            raise RuntimeError("what was cancelled goes on")
        if not (folder / f"R.shard-2-of-{parts}.h5.journal").exists():
            raise RuntimeError("a cancelled task left no journal")
        print("cancelled: not queued again, the journal is kept")
    except RuntimeError as error:
        print(f"FAIL: {error}")
        for log in sorted(folder.glob("*.log")) + sorted((folder / "cluster").glob("*.log")):
            print(f"--- {log.name}\n" + "\n".join(log.read_text(errors="replace").splitlines()[-20:]))
        return 1
    finally:
        cluster.stop()
    return 0


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    parts = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    if os.geteuid() != 0:
        print("only root can start a Slurm")
        return 77
    install()
    with tempfile.TemporaryDirectory(prefix="millstudy-slurm-") as name:
        folder = pathlib.Path(name)
        (folder / "cluster").mkdir()
        folder.chmod(0o755)
        return run(program, parts, folder)


if __name__ == "__main__":
    sys.exit(main())
