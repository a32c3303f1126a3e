#!/bin/sh
# GNU parallel: 40 shards, four at a time. Run it again after a stop: finished shards are skipped, others go on.
exec parallel --jobs 4 --halt soon,fail=1 \
    motion-lab sweep noise.ron --shard '{}/40' --jobs 1 -o noise.sweep ::: $(seq 40)
