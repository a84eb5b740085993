#!/bin/bash
# Reproduces the figures and the table of the paper by its own method and by the library: see usage().
set -euo pipefail

usage()
{
    cat >&2 <<END
Reproduces the figures and the table of the paper by its own method and by the library, and measures more than it has: \
tables in OUTPUT/tables,
plots in OUTPUT/images/paper, strips of photographs in OUTPUT/tables/strips, and the page OUTPUT/paper.md. \
Tables that are there already are
kept, so that a run that was interrupted goes on. The same for a seed, but for times.
usage: reproduce_paper.sh BUILD OUTPUT [--photos=FOLDER] [--quick] [--seed=N] [--threads=N]
  --photos  folder with a frames.csv (see rsackermann_reproduce_paper --help), or of such folders
  --quick   a part of the cases
END
    exit 2
}

here=$(cd "$(dirname "$0")" && pwd)/paper
[ $# -ge 2 ] || usage
build=$1
output=$2
shift 2
photos="" options=() made_with=()
speeds="20 60 100 140"
for argument in "$@"; do
    case $argument in
        --photos=*) photos=${argument#--photos=} ;;
        --quick) speeds="20 100"; options+=("$argument"); made_with+=("$argument") ;;
        --seed=*) options+=("$argument"); made_with+=("$argument") ;;
        --threads=*) options+=("$argument") ;;
        *) usage ;;
    esac
done
command -v gnuplot >/dev/null || { echo "$0: gnuplot is missing (Debian: gnuplot-nox)" >&2; exit 1; }

tables=$output/tables
images=$output/images/paper
mkdir -p "$tables" "$images"
settings=${made_with[*]:-defaults}
[ "$(cat "$tables/settings.txt" 2>/dev/null || echo "$settings")" = "$settings" ] ||
    { echo "$0: $tables was made with other options: $(cat "$tables/settings.txt")" >&2; exit 1; }
echo "$settings" >"$tables/settings.txt"

# Times are measured on their own, before the others warm up the machine.
studies=(time solver_time motion patches gravity distances solvers bound conditions)
[ -z "$photos" ] || { studies+=(photos); options+=("--photos=$photos"); }
"$build/perf/experiments/paper/rsackermann_reproduce_paper" "${studies[@]}" "--output=$tables" \
    ${options[@]+"${options[@]}"}

data=$(mktemp -d)
trap 'rm -rf "$data"' EXIT
export PYTHONDONTWRITEBYTECODE=1
"$here/plot_data.py" "$tables" "$data"
gnuplot -c "$here/plots.gp" "$data" "$images" "$speeds"
"$here/make_page.py" "$tables" "$here/page.md" "$output/paper.md"
echo "$output/paper.md"
