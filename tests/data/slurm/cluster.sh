#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A Slurm of one node on this machine, in a folder of its own.
#
#   cluster.sh start DIR PORT    munged, slurmctld at PORT and slurmd at PORT + 1; returns when the node is idle
#   cluster.sh stop DIR          returns when they have ended
set -euo pipefail

folder=$2
if [[ $1 == stop ]]; then
    for name in slurmd slurmctld munged; do
        if [[ ! -s $folder/run/$name.pid ]]; then continue; fi
        pid=$(<"$folder/run/$name.pid")
        kill "$pid" 2>/dev/null || true
        for _ in {1..100}; do
            if ! kill -0 "$pid" 2>/dev/null; then break; fi
            sleep 0.1
        done
    done
    exit 0
fi
port=$3
host=$(hostname -s)
mkdir -p "$folder/run" "$folder/state" "$folder/spool"
chmod 711 "$folder" "$folder/run"
head -c 1024 /dev/urandom >"$folder/munge.key"
chmod 400 "$folder/munge.key"
munged --force --key-file="$folder/munge.key" --socket="$folder/run/munge.socket" \
    --pid-file="$folder/run/munged.pid" --log-file="$folder/munged.log" --seed-file="$folder/munged.seed" 2>/dev/null
cat >"$folder/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/run/munge.socket
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SwitchType=switch/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000
PartitionName=main Nodes=$host Default=YES State=UP
END
slurmctld -f "$folder/slurm.conf" -c
slurmd -f "$folder/slurm.conf" -c
export SLURM_CONF=$folder/slurm.conf
for _ in {1..100}; do
    if [[ $(sinfo -h -o %t 2>/dev/null) == idle ]]; then exit 0; fi
    sleep 0.2
done
echo "the node does not come up:" >&2
tail -3 "$folder/slurmctld.log" "$folder/slurmd.log" >&2
exit 1
