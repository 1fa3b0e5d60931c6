#!/bin/sh
# A user's first steps with the installed packages: first_steps.sh PREFIX, in an empty directory.
# The tutorial of the Python module needs matplotlib and pandas.
set -eux
prefix=$1
PATH=$prefix/bin:$PATH
export PYTHONPATH="$prefix/lib/python3/dist-packages" MPLBACKEND=Agg
scenes=$prefix/share/lobelia/scenes

lobelia render reference_scenes/scenes/oblique_45.xml -o picture.exr  # as in the README, here the installed one
lobelia compare picture.exr picture.exr
lobelia render "$scenes/oblique_45.xml" --model modified_phong -o other.exr
code=0
lobelia compare other.exr picture.exr || code=$?
test "$code" = 1

ln -s "$scenes" scenes  # a path in a list of a grid has no blanks
cat > grid.xml << 'GRID'
<grid version="1" title="Formulas">
  <scene file="scenes/oblique_45.xml"/>
  <axis name="model" values="phong_rdf, modified_phong"/>
  <axis name="exponent" values="16, 128"/>
  <engine name="analytic"/>
</grid>
GRID
lobelia farm grid.xml -o farm
lobelia gallery farm -o site
test -s site/index.html

/usr/bin/python3 - "$prefix/share/doc/lobelia/docs/python_tutorial.ipynb" > tutorial.py << 'CODE'
import json, sys
for cell in json.load(open(sys.argv[1]))["cells"]:
    if cell["cell_type"] == "code":
        print("".join(cell["source"]))
CODE
test -s tutorial.py
/usr/bin/python3 tutorial.py
