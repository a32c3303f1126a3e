#!/bin/sh
# HyperQueue: 200 shards on whatever workers there are. A task that is lost with its worker is run again and goes on.
exec hq submit --array 1-200 --cpus 1 --crash-limit 5 -- \
    motion-lab sweep noise.ron --shard auto/200 --jobs 1 -o noise.sweep
