#!/usr/bin/env bash
# Makes the pictures of README and docs anew, with the program itself: scripts/make_pictures.sh
set -euo pipefail
cd "$(dirname "$0")/.."
[ -x build/release/bin/ostia ] || scripts/build.sh release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build/release/bin/ostia model --builtin -o "$work/builtin"
mkdir -p docs/pictures
cp "$work"/builtin/pictures/*.png docs/pictures/
build/release/bin/ostia phantom -o "$work/phantom" --preset full --seed 3 --formats nrrd
for picture in axial mip tree; do
  cp "$work/phantom/dataset00/report/$picture.png" "docs/pictures/phantom-$picture.png"
done

# A mask that becomes a case.
build/release/bin/ostia phantom -o "$work/masked" --preset small --formats nrrd --no-report
build/release/bin/ostia extract "$work/masked/dataset00/labels.nrrd" --label 20 -o "$work/masked.ostia"
build/release/bin/ostia report "$work/masked.ostia" -o "$work/masked-report"
cp "$work/masked-report/images/tree.png" docs/pictures/mask-tree.png
build/release/bin/ostia phantom -o "$work/around" --preset small --seed 5 --tree "$work/masked.ostia" --truth-only --surface-spacing 1
cp "$work/around/dataset00/report/heart.png" docs/pictures/phantom-trees.png

build/release/bin/model_picture docs/pictures/lumen-model.png
build/release/bin/joint_picture docs/pictures/lumen-joint.png
build/release/bin/editing_picture docs/pictures/editing-dismissal.png
build/release/bin/reformation_picture "$work/phantom/dataset00" vessel1 docs/pictures/reformations.png
build/release/bin/contour_picture "$work/phantom/dataset00" vessel1 docs/pictures/lumen-contours.png
build/release/bin/boundary_picture "$work/phantom/dataset00" vessel1 s01 docs/pictures/lumen-boundary.png
build/release/bin/outer_wall_picture "$work/phantom/dataset00" vessel1 s01 docs/pictures/outer-wall.png
build/release/bin/plaque_picture "$work/phantom/dataset00" 3 LAD docs/pictures/plaque.png
build/release/bin/layer_picture docs/pictures/boundary-layer.png
build/release/bin/hexahedra_picture docs/pictures/hexahedra.png
build/release/bin/extension_picture sections docs/pictures/flow-extensions.png
build/release/bin/bifurcation_picture branches fork docs/pictures/bifurcations-branches.png
build/release/bin/bifurcation_picture patches fork docs/pictures/bifurcations-patches.png
build/release/bin/filters_picture "$work/phantom/dataset00" vessel1 docs/pictures/filters.png
build/release/bin/uncertainty_picture docs/pictures/pressure-uncertainty.png
PYTHONPATH=build/release/python /usr/bin/python3 -B scripts/python_picture.py README.md docs/pictures/python.png

# A minute: real images and the phantom's measured alike; real ones that are not there are named and left out.
build/release/bin/scan_comparison "${OSTIA_SHARED_DATA:-../shared/data}" "$work/scans"
cp "$work/scans/options.png" docs/pictures/scan-options.png
cp "$work/scans/spectra.png" docs/pictures/scan-spectra.png
cp "$work/scans/profiles.png" docs/pictures/scan-profiles.png

# Where OpenFOAM is installed: the first flow of the researcher's tutorial.
if command -v simpleFoam > /dev/null; then
  build/release/bin/ostia mesh "$work/builtin/lumen.vtp" -o "$work/mesh" --centerline "$work/builtin/centerlines.vtp" \
    --edge-ratio 0.4 --layers 3 --layer-thickness 0.5
  build/release/bin/ostia case "$work/mesh/mesh.vtu" -o "$work/flow" --flow 1.0 --outlets split
  "$work/flow/Allrun"
  build/release/bin/ostia result "$work/flow" -o "$work/flow-result"
  cp "$work/flow-result/wall_shear_stress.png" docs/pictures/flow-wall-shear-stress.png
  cp "$work/flow-result/speed.png" docs/pictures/flow-speed.png
fi

# Some minutes: the tubes scanned in twelve orientations.
build/release/bin/ostia experiment orientations -o "$work/orientations"
cp "$work/orientations/length.png" docs/pictures/orientations-length.png
cp "$work/orientations/radius.png" docs/pictures/orientations-radius.png

# Some minutes: the same tubes reconstructed.
build/release/bin/ostia experiment smoothness -o "$work/smoothness"
cp "$work/smoothness/distance.png" docs/pictures/smoothness-distance.png
cp "$work/smoothness/smoothness.png" docs/pictures/smoothness-curvature.png

# Some minutes: walls found in noise, against the truth.
build/release/bin/ostia experiment wall-spread -o "$work/wall-spread"
cp "$work/wall-spread/wall-spread.png" docs/pictures/wall-spread.png

# A minute: the whole chain on a synthetic heart, its coronary arteries against the aorta.
build/release/bin/ostia phantom -o "$work/chain-heart" --preset small --formats nrrd --no-report
build/release/bin/ostia experiment chain "$work/chain-heart/dataset00/image00.nrrd" -o "$work/chain" --thinnest 1 --least 180 \
  --seed 20.7,-6.4,29.0 --seed 35.4,-16.5,31.3 --seed 20.5,-3.4,28.5 --seed 31.9,10.7,35.3 --rival 3.2,-4.7,18.3 \
  --seed=-17.0,-34.7,14.7 --seed=-29.6,-39.7,5.8 --rival=-5.4,-17.8,12.9
cp "$work/chain/figure.png" docs/pictures/chain.png

# A minute: a tree grown down to the last arterioles, and its measures.
build/release/bin/ostia phantom -o "$work/heart" --preset small --truth-only
build/release/bin/ostia convert "$work/heart/dataset00/centerlines.vtp" "$work/scanned.vtp" --repair
build/release/bin/ostia grow "$work/scanned.vtp" -o "$work/grown.vtp" --artery lad --seed 7
build/release/bin/ostia-live "$work/grown.vtp" --screenshot docs/pictures/huge-trees.png
build/release/bin/ostia measure "$work/grown.vtp" -o "$work/measures"
cp "$work/measures/pictures/diameter-by-order.png" docs/pictures/tutorial-trees-diameters.png

# Half an hour: the editing experiment on 78 sections.
build/release/bin/ostia phantom -o "$work/suite18" --cases 18 --truth-only
build/release/bin/ostia experiment editing --suite "$work/suite18" -o "$work/editing"
cp "$work/editing/accuracy.png" docs/pictures/editing-accuracy.png
cp "$work/editing/one-section.png" docs/pictures/editing-one-section.png

# Patients' trees with the names that were written down, where $OSTIA_SHARED_DATA has their masks.
for mask in "${OSTIA_SHARED_DATA:-../shared/data}"/coronary/patient-masks/*.nrrd; do
  [ -e "$mask" ] || continue
  build/release/bin/names_picture "$mask" data/names/patients.csv "docs/pictures/names-$(basename "$mask" .nrrd).png"
done

# An hour and 2 GB of disk: the coronary tree without a click on 18 scans.
build/release/bin/ostia phantom -o "$work/scans18" --preset full --cases 18 --formats nrrd --no-report
build/release/bin/ostia experiment extraction --suite "$work/scans18" -o "$work/extraction"
cp "$work/extraction/diameters.png" docs/pictures/extraction-diameters.png

# Hours, of which the comparison of methods takes most: hearts whose motion is known. Runs that are finished are kept in
# $MOTION_RUNS, where it is set, and a second start goes on from there.
build/release/bin/ostia experiment motion -o "$work/motion" --keep "${MOTION_RUNS:-$work/motion-runs}"
cp "$work/motion/samplings.png" docs/pictures/motion-samplings.png

# The live viewer on record 100 of the MIT-BIH database, where $RECORD_100 names its 100.hea.
if [ -n "${RECORD_100:-}" ]; then
  build/release/bin/ostia-live --demo --view RAO30 --ecg "$RECORD_100" --start 10.22 --color displacement \
    --screenshot docs/pictures/live.png
fi

# How much the segmentation depends on its parameters; and, where a lumen with open ends is given in $CAROTID, the carotid phantom.
build/release/bin/ostia experiment sensitivity -o "$work/sensitivity"
cp "$work/sensitivity/sensitivity.png" docs/pictures/sensitivity.png
if [ -n "${CAROTID:-}" ]; then
  build/release/bin/ostia experiment carotid --surface "$CAROTID" -o "$work/carotid"
  for picture in slices distances calibre; do cp "$work/carotid/$picture.png" "docs/pictures/carotid-$picture.png"; done
fi

# Where the real images are: the one that may be shown.
data=${OSTIA_SHARED_DATA:-../shared/data}
if [ -d "$data/cta" ]; then
  scripts/real_images.sh "$data" "$work/real"
  cp "$work/real/aorta-report/images/vessel-3.png" docs/pictures/real-rca.png
fi

# Pressure in one dimension against the three-dimensional runs that are kept.
build/release/bin/ostia experiment pressure -o "$work/pressure" --keep data/pressure --judge
cp "$work/pressure/agreement.png" docs/pictures/pressure-agreement.png

# The tutorial of regression tests: a model held against the truth, and two models against each other.
cd "$work"
PATH=$OLDPWD/build/release/bin:$PATH
pictures=$OLDPWD/docs/pictures
ostia phantom -o suite --preset full --formats nrrd
click() { tr ' ' ',' < "suite/dataset00/$1/point$2.txt"; }
branch() { echo "$(click "$1" S):$(click "$1" B):$(click "$1" A)"; }
for run in run1 run2; do
  mkdir -p "$run/dataset00"
  more=()
  [ "$run" = run1 ] || more=(--smooth 30)
  ostia model suite/dataset00/image00.nrrd -o "$run/dataset00/left" --inset 0.3 "${more[@]}" \
    --branch "$(branch vessel1)" --branch "$(branch vessel2)" --branch "$(branch vessel3)"
  ostia model suite/dataset00/image00.nrrd -o "$run/dataset00/right" --inset 0.3 "${more[@]}" --branch "$(branch vessel0)"
done
ostia evaluate surface suite/dataset00 run1/dataset00 --covered --picture "$pictures/tutorial-qa-truth.png"
ostia evaluate surface run1/dataset00/left/lumen.vtp run2/dataset00/left/lumen.vtp --picture "$pictures/tutorial-qa-suite.png"
