# Labels for pictures. To be sourced.

readonly label_font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf

# label_columns PICTURE OUTPUT LABEL...: a dark strip below the picture, with a label centered under each of as many columns as
# there are labels. `|` in a label starts a second, smaller line.
label_columns() {
  local -r picture=$1 output=$2
  shift 2
  local -r columns=$# strip=64
  local width height column=0 label middle
  read -r width height < <(oiiotool --info "$picture" | sed -n 's/.*: *\([0-9]*\) x *\([0-9]*\),.*/\1 \2/p')
  local -a words=(--create "${width}x$((height + strip))" 3 --fill:color=0.12,0.12,0.12 "${width}x$((height + strip))"
    "$picture" --swap --paste +0+0)
  for label in "$@"; do
    middle=$(((2 * column + 1) * width / (2 * columns)))
    words+=("--text:x=$middle:y=$((height + 24)):size=20:xalign=center:color=0.95,0.95,0.95:font=$label_font" "${label%%|*}")
    if [[ $label == *'|'* ]]; then
      words+=("--text:x=$middle:y=$((height + 48)):size=15:xalign=center:color=0.7,0.7,0.7:font=$label_font" "${label#*|}")
    fi
    ((column += 1))
  done
  oiiotool "${words[@]}" -d uint8 -o "$output"
}
