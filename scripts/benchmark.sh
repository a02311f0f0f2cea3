#!/usr/bin/env bash
# Runs the benchmark programs of a finished build.
#
#   scripts/benchmark.sh [quick|full]     quick: minutes, into build/results_quick (default); full: the counts kept in
#                                         doc/results, a quarter of an hour on two cores, and recorded there
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
size=${1:-quick}
case $size in
  quick) overlaps=500 lattices=300 hole_facets=6,20 protrusions=8,16 tree_seeds=10 runs=200 niche_runs=60 steps=200 window=4 proof_poses=200 sizes=1000,10000,100000 spacings=0,0.02 rings=100000 wall=2 island_runs=2 brackets=20000 cycle_seconds=5 scene_cycles=50 churn_seconds=20 edit_runs=1 motions=24 guard_runs=8 ;;
  full) overlaps=10000 lattices=2000 hole_facets=6,12,20,40 protrusions=1,4,8,16,32 tree_seeds=50 runs=1000 niche_runs=500 steps=500 window=10 proof_poses=7000 sizes=1000,10000,100000,1000000
    spacings=0,0.01 rings=1000000 wall=6 island_runs=20 brackets=1000000 cycle_seconds=60 scene_cycles=300 churn_seconds=600 edit_runs=2 motions=1000 guard_runs=200 ;;
  *) echo "usage: scripts/benchmark.sh [quick|full]" >&2; exit 2 ;;
esac
program() { find "$root/build" -type f -perm -u+x -name "$1" | head -n 1; }
for name in tracking scene churn clearance guard edit battery bracket budget front generation descent islands certificate scale exactness complete accuracy; do
  [ -n "$(program "${name}_benchmark")" ] || { echo "${name}_benchmark is not built: run scripts/build.sh" >&2; exit 1; }
done
results=$root/build/results_quick
if [ "$size" = full ]; then
  results=$root/doc/results
  cmake --build "$root/build" --target concave_distance_benchmarks  # the recorded commit is that of the programs
fi
started=$(mktemp)  # older than every file that this run writes
trap 'rm -rf "$started" "${folder:-}"' EXIT
mkdir -p "$results"
"$(program tracking_benchmark)" --steps "$steps" --output "$results/tracking.csv" | tee "$results/tracking.txt"
"$(program tracking_benchmark)" --steps "$steps,$((10 * steps))" --cutoffs 0,0.5 --output "$results/niche_costs.csv"
"$(program tracking_benchmark)" --pairs simple --steps "$steps" --output "$results/simple_pairs.csv"
"$(program scene_benchmark)" --cycles "$scene_cycles" --fcl-cycles 5 --output "$results/scene.csv"
"$(program churn_benchmark)" --seconds "$churn_seconds" --output "$results/churn.csv"
"$(program clearance_benchmark)" --motions "$motions" --fixed-every 20 --output "$results/clearance.csv" \
  --times-output "$results/clearance_times.csv"
"$(program guard_benchmark)" --runs "$guard_runs" --output "$results/guard.csv"
"$(program edit_benchmark)" --instants "$edit_runs" --runs "$edit_runs" --output "$results/edit.csv"
"$(program battery_benchmark)" --runs "$runs" --niche-runs "$niche_runs" --output "$results/battery.csv" |
  tee "$results/battery.txt"
"$(program islands_benchmark)" --runs "$island_runs" --output "$results/islands.csv"
"$(program certificate_benchmark)" --output "$results/certificate.csv" | tee "$results/certificate.txt"
"$(program contact_scenes)" --wall "$wall" --output "$results/contact_scenes.csv" | tee "$results/contact_scenes.txt"
"$(program effects_benchmark)" --output "$results/effects.csv" | tee "$results/effects.txt"
"$(program scale_benchmark)" --sizes "$sizes" --output "$results/scale.csv" | tee "$results/scale.txt"
"$(program complete_benchmark)" --steps "$steps" --window "$window" 8 --cold-runs 12 \
  --output "$results/complete.csv" | tee "$results/complete.txt"
"$(program exactness_benchmark)" --poses "$proof_poses" --output "$results/exactness.csv" | tee "$results/exactness.txt"
if [ -n "$(program partition_benchmark)" ]; then  # built with CGAL only
  family=()
  if /usr/bin/python3 -c "import numpy" 2>/dev/null; then
    folder=$(mktemp -d)
    /usr/bin/python3 "$root/scripts/generate_geometry.py" partition "$folder" --hole-facets "$hole_facets" \
      --protrusions "$protrusions"
    family=(--family "$folder" --hole-facets "$hole_facets" --protrusions "$protrusions")
  else
    echo "no batteries with more pieces: install python3-numpy (scripts/install_dependencies.sh plot)" >&2
  fi
  "$(program partition_benchmark)" "${family[@]}" --output "$results/partition.csv" \
    --curves-output "$results/manoeuvre.csv" | tee "$results/partition.txt"
fi
if [ -n "$(program interference_benchmark)" ]; then  # built with CGAL only
  "$(program interference_benchmark)" --pairs "$overlaps" --lattice-pairs "$lattices" --output "$results/interference.csv" |
    tee "$results/interference.txt"
fi
if [ -n "$(program continuous_benchmark)" ]; then  # built with CGAL only
  "$(program continuous_benchmark)" --seeds "$tree_seeds" --output "$results/continuous.csv"
fi
moving=battery_insertion,kr5_bicep_palm,kr5_base_forearm,kr5_shoulder_elbow,wam3_wam5,wam_base_wam4,wam1_wam6
moving=$moving,peg_in_hole,linked_hooks,comb_in_comb,stairs_leg,obstacle_field
"$(program front_benchmark)" --steps 500,5000 --instants "$steps" --windows 1 --output "$results/front.csv"
"$(program generation_benchmark)" --steps 500 --robot "$root" --output "$results/generations.csv"
"$(program budget_benchmark)" --pairs "$moving" --steps "$steps" --output "$results/budget.csv"
"$(program budget_benchmark)" --cold --pairs "$moving" --budgets 500,1000,2000,5000,10000,20000 --shares 0,0.05 \
  --proposers evolution,random --steps 60 --output "$results/budget_cold.csv"
"$(program accuracy_benchmark)" --output "$results/accuracy.csv" --stages-output "$results/stages.csv" | tee "$results/accuracy.txt"
"$(program bracket_benchmark)" --cycles "$brackets" --output "$results/brackets.csv"
if [ -n "$(program cycle_benchmark)" ]; then  # built with ROS only
  scenes=(robot cell)
  robots=/usr/share/doc/dart/data
  if [ -d "$robots" ]; then
    atlas=$robots/sdf/atlas/atlas_v3_no_head.urdf hubo=$robots/urdf/drchubo/drchubo.urdf
    "$root/test/benchmark/write_srdf.py" "$atlas" 168 >"$root/build/atlas.srdf"
    "$root/test/benchmark/write_srdf.py" "$hubo" 768 >"$root/build/drchubo.srdf"
    scenes+=("$robots/urdf/KR5/KR5 sixx R650.urdf" "$atlas,$root/build/atlas.srdf" "$hubo,$root/build/drchubo.srdf")
  else
    echo "no robots in motion: apt-get install dart-doc" >&2
  fi
  "$(program cycle_benchmark)" "${scenes[@]}" --seconds "$cycle_seconds" --output "$results/cycles.csv"
fi
if [ -n "$(program message_benchmark)" ]; then  # built with ROS only
  "$(program message_benchmark)" --output "$results/messages.csv" | tee "$results/messages.txt"
fi
if [ -n "$(program engine_table)" ]; then  # built with Simbody and ODE only
  "$(program engine_table)" --output "$results/engine_table.csv"
fi
if [ "$size" = full ]; then
  find "$results" -maxdepth 1 \( -name '*.csv' -o -name '*.txt' \) ! -name runs.csv ! -name numbers.csv -newer "$started" \
    -exec "$root/test/scripts/check_results.py" --record {} +
fi
