#!/bin/bash
# A Slurm array of 8 shards: sbatch slurm.sh. Shards that were stopped or failed: sbatch --array=3,7 slurm.sh
#SBATCH --job-name=sweep
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --mem=2G
#SBATCH --time=01:00:00
#SBATCH --requeue
# a minute before the end of its time the task stops with exit code 75 and keeps its rows
#SBATCH --signal=B:TERM@60
exec motion-lab sweep noise.ron --shard auto/8 --jobs "$SLURM_CPUS_PER_TASK" -o noise.sweep
