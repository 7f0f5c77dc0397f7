# This file draws labels for pictures. Source it after steps.bash.

readonly label_font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf

# label_columns PICTURE OUTPUT LABEL... adds a dark strip below the picture, with one centered label per column. `|` in a
# label starts a second, smaller line.
label_columns() {
  local -r unlabelled=$1 labelled=$2
  shift 2
  local -r columns=$# strip=64
  local width height column=0 label middle
  read -r width height < <(oiiotool --info "$unlabelled" | sed -n 's/.*: *\([0-9]*\) x *\([0-9]*\),.*/\1 \2/p')
  local -a words=(--create "${width}x$((height + strip))" 3 --fill:color=0.12,0.12,0.12 "${width}x$((height + strip))"
    "$unlabelled" --swap --paste +0+0)
  for label in "$@"; do
    middle=$(((2 * column + 1) * width / (2 * columns)))
    words+=("--text:x=$middle:y=$((height + 24)):size=20:xalign=center:color=0.95,0.95,0.95:font=$label_font" "${label%%|*}")
    if [[ $label == *'|'* ]]; then
      words+=("--text:x=$middle:y=$((height + 48)):size=15:xalign=center:color=0.7,0.7,0.7:font=$label_font" "${label#*|}")
    fi
    ((column += 1))
  done
  oiiotool --nosoftwareattrib "${words[@]}" -d uint8 -o "$labelled"
}
