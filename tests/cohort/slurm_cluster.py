"""Slurm on this machine alone: munged, slurmctld and one slurmd in a folder, as a test needs them. For root, as slurmd is."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "scancel")


def missing():
    """What is not here that a cluster needs; nothing: one can be started."""
    gone = [name for name in PROGRAMS if not shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")]
    return ", ".join(gone) or ("to be root" if os.geteuid() != 0 else "")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    def __init__(self, folder, cores, memory_mb):
        self.folder, self.running = pathlib.Path(folder), {}
        self.host = host = socket.gethostname().split(".")[0]
        control, node = free_ports(2)
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir(mode=0o755, parents=True)
        self.key = self.folder / "munge/key"
        self.key.write_bytes(os.urandom(128))
        self.key.chmod(0o600)
        (self.folder / "slurm.conf").write_text(f"""
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
SlurmdPort={node}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge/socket
CredType=cred/munge
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=1,sched_interval=5
ReturnToService=2
KillWait=3
MessageTimeout=10
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory_mb} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")
        os.environ["PATH"] += ":/usr/sbin:/sbin"
        self.start("munged", "--foreground", "--force", f"--key-file={self.key}", f"--socket={self.folder}/munge/socket", f"--pid-file={self.folder}/munge/pid",
                   f"--log-file={self.folder}/munge/log", f"--seed-file={self.folder}/munge/seed")
        self.wait_for(lambda: (self.folder / "munge/socket").exists())
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", host)
        self.wait_for(lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"))

    def start(self, name, *words):
        with open(self.folder / f"{name}.out", "ab") as out:
            self.running[name] = subprocess.Popen([name, *words], stdout=out, stderr=out, stdin=subprocess.DEVNULL)

    def ask(self, *words):
        return subprocess.run(words, capture_output=True, text=True, check=False).stdout

    def wait_for(self, is_so, seconds=60):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                raise RuntimeError("the cluster does not start: " + "".join(p.read_text()[-1000:] for p in self.folder.glob("*.out")))
            time.sleep(0.1)

    def jobs(self):
        return self.ask("squeue", "-h", "-t", "RUNNING", "-o", "%i").split()

    def kill_job(self, job):
        subprocess.run(["scancel", "--signal=KILL", "--full", job], capture_output=True, check=False)

    def kill_controller(self):
        """And start it anew: a machine that goes down and comes back."""
        self.running["slurmctld"].send_signal(signal.SIGKILL)
        self.running["slurmctld"].wait()
        self.start("slurmctld", "-D")

    def mend(self):
        """As who keeps the cluster does: a controller that was killed before it had written down that a job runs starts it again, and closes the node that refuses that."""
        if "drain" in self.ask("sinfo", "-h", "-o", "%T"):
            self.ask("scontrol", "update", f"NodeName={self.host}", "State=RESUME")
        for job in self.ask("squeue", "-h", "-t", "PENDING", "-o", "%A %r").splitlines():
            if "Held" in job:
                self.ask("scontrol", "release", job.split()[0])

    def stop(self):
        self.ask("scancel", "--user=root")
        for name in ("slurmd", "slurmctld", "munged"):
            if name in self.running:
                self.running[name].terminate()
                try:
                    self.running[name].wait(20)
                except subprocess.TimeoutExpired:
                    self.running[name].kill()
                    self.running[name].wait()
