#!/bin/bash
# Every f32 through the functions of all materials, in 61 shards, as a Slurm array:
#
#   sbatch slurm.sh                  all shards
#   sbatch --array=5,17 slurm.sh     shards 5 and 17 once more
#   fresnel-gen merge part-*.json -o report.json
#
#SBATCH --array=0-60
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=02:00:00
#SBATCH --output=task-%a.txt

# Which shard this is says SLURM_ARRAY_TASK_ID. How many there are stands here alone: in an array that is run again in part, Slurm
# counts the tasks of that part.
fresnel-gen verify --exhaustive --target wgsl --method all --material all \
    --shards 61 --json "part-$SLURM_ARRAY_TASK_ID.json"
status=$?
# A shard with findings (1) has done its work. `merge` ends with 1 then.
[ "$status" -le 1 ] || exit "$status"
