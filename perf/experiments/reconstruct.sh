#!/bin/bash
# Measures what the correction is worth to structure from motion: see usage().
set -euo pipefail

usage()
{
    cat >&2 <<END
Reconstructs rendered drives with COLMAP, from raw images, from corrected ones and from those of a global shutter, and
compares the cameras with the true ones, and points of raw images that are triangulated with the poses of their rows.
Prints tables in Markdown and plots the errors of the centres to OUTPUT/reconstruction.png; everything else is in OUTPUT, too. What is complete there is kept, so that a run that was
interrupted goes on. An hour on two cores.
usage: reconstruct.sh BUILD OUTPUT [DRIVES]
  DRIVES  of each of both views (default 3)
END
    exit 2
}

die()
{
    echo "$0: $*" >&2
    exit 1
}

here=$(cd "$(dirname "$0")" && pwd)/reconstruction
case $# in 2 | 3) ;; *) usage ;; esac
programs=$1/samples output=$2 drives=${3:-3}
python=${PYTHON:-/usr/bin/python3}
command -v colmap >/dev/null || die "COLMAP is missing (Debian: colmap)"
command -v gnuplot >/dev/null || die "gnuplot is missing (Debian: gnuplot-nox)"
"$python" -c 'import cv2, numpy' 2>/dev/null || die "$python has no OpenCV (Debian: python3-opencv; PYTHON names another one)"
[ -x "$programs/rsackermann_correct" ] || die "$programs has no programs"
export QT_QPA_PLATFORM=offscreen PYTHONDONTWRITEBYTECODE=1

frames=180 step=3
width=640 height=360 focal=533 # a dashcam's horizontal field of view of 62 degrees

# usage: once DRIVE STEP COMMAND...; runs a command unless it has succeeded before
once()
{
    local done=$1/$2.done
    shift 2
    [ ! -e "$done" ] || return 0
    "$@" >>"$output/log.txt" 2>&1
    touch "$done"
}

# usage: simulate DRIVE HEADING SEED
simulate()
{
    "$programs/rsackermann_simulate" --output="$1" --overwrite --frames=$frames --heading="$2" --seed="$3" \
        --size=${width}x$height --focal=$focal --readout=0.03 --height=1.4 --left=6 --right=8 --stagger=1.5 \
        --obstacles=15 --speed=40 --speed_swing=8 --yaw_rate=15 --shake=suspension --stains=0.3 --rays=staggered --depth --global
}

# usage: correct DRIVE KIND LOG OPTION...; images, and the masks of what they show
correct()
{
    local drive=$1 kind=$2 log=$3
    shift 3
    "$programs/rsackermann_correct" "$drive/frames" --camera="$drive/camera.yml" --smooth --log="$log" --overwrite \
        --output="$drive/$kind" --report="$drive/$kind.jsonl" "$@"
    rm -rf "$drive/colmap_$kind"
    "$programs/rsackermann_export" --report="$drive/$kind.jsonl" --camera="$drive/camera.yml" --colmap="$drive/colmap_$kind"
}

# usage: reconstruct DRIVE KIND
# COLMAP's defaults, but for the known camera, features of the pixels as they are, and a pair of images in the middle of
# the drive to begin with: by default only pairs that don't move forward are allowed, and ahead those are wrong ones.
reconstruct()
{
    local drive=$1 kind=$2 model=$1/model_$2 masks=()
    [ ! -d "$drive/colmap_$kind" ] || masks=(--ImageReader.mask_path "$drive/colmap_$kind/masks")
    rm -rf "$model"
    mkdir -p "$model/sparse"
    colmap feature_extractor --database_path "$model/database" --image_path "$drive/$kind" \
        --image_list_path "$drive/images.txt" --SiftExtraction.use_gpu 0 --ImageReader.single_camera 1 \
        --SiftExtraction.first_octave 0 --ImageReader.camera_model PINHOLE \
        --ImageReader.camera_params "$focal,$focal,$((width / 2)),$((height / 2))" "${masks[@]}"
    colmap sequential_matcher --database_path "$model/database" --SiftMatching.use_gpu 0
    colmap mapper --database_path "$model/database" --image_path "$drive/$kind" --output_path "$model/sparse" \
        --Mapper.ba_refine_focal_length 0 --Mapper.ba_refine_extra_params 0 --Mapper.init_image_id1 30 \
        --Mapper.init_image_id2 33 --Mapper.init_min_tri_angle 4 --Mapper.init_max_forward_motion 1
    for folder in "$model"/sparse/*; do
        colmap model_converter --input_path "$folder" --output_path "$folder" --output_type TXT
    done
    "$python" "$here/compare_poses.py" "$drive/truth.jsonl" "$model"/sparse/* >"$model/poses.txt"
}

# usage: triangulate DRIVE KIND; points of raw frames, with the poses of rows that were found with the log of a kind
triangulate()
{
    "$programs/rsackermann_export" --report="$1/$2.jsonl" --camera="$1/camera.yml" --row_poses="$1/rows_$2.json"
    "$python" "$here/compare_points.py" "$1" "$1/model_frames/sparse/0" "$1/rows_$2.json" >"$1/points_$2.txt"
}

mkdir -p "$output"
: >"$output/log.txt"
exec 3>&2
trap '[ $? = 0 ] || echo "$0: $output/log.txt ends with the reason" >&3' EXIT
: >"$output/cameras.txt"
: >"$output/points.txt"
for number in $(seq "$drives"); do
    for view in side forward; do
        drive=$output/$view$number
        mkdir -p "$drive"
        heading=0
        [ $view = forward ] || heading=-90
        once "$drive" simulated simulate "$drive" $heading "$number"
        seq -f '%06g.png' 0 $step $((frames - 1)) >"$drive/images.txt"
        "$python" "$here/write_log.py" "$drive/truth.jsonl" speed_kmh >"$drive/speed.csv"
        "$python" "$here/write_log.py" "$drive/truth.jsonl" speed_kmh yaw_rate_deg_s >"$drive/yaw_rate.csv"
        once "$drive" corrected correct "$drive" corrected "$drive/speed.csv"
        once "$drive" yaw_rate_depth correct "$drive" yaw_rate_depth "$drive/yaw_rate.csv" --depth="$drive/depth" \
            --depth_scale=0.00390625 # metres: 1/256
        for kind in frames corrected yaw_rate_depth global; do
            echo "$view $number $kind" >&2
            once "$drive" model_$kind reconstruct "$drive" $kind
            echo "$view $kind $number $(cat "$drive/model_$kind/poses.txt")" >>"$output/cameras.txt"
        done
        for kind in corrected yaw_rate_depth; do
            once "$drive" points_$kind triangulate "$drive" $kind
            echo "$view $kind $number $(cat "$drive/points_$kind.txt")" >>"$output/points.txt"
        done
    done
done
"$python" "$here/table.py" "$output" $((frames / step))
gnuplot -c "$here/plot.gp" "$output" "$output/reconstruction.png"
