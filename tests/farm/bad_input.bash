# What index, convert in parts and merge-reports say to manifests, parts, environments and folders that are wrong. Each case: the
# exit code, and a line on standard error that has the words and a remedy in parentheses; nothing unfinished is left.
#
#   bad_input.bash TEXREMAP
set -uo pipefail
texremap=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly convert=(convert --from mitsuba/ward --to mitsuba/ggx --quiet)
passed=0 failed=0
environment=()

/usr/bin/python3 -c 'import numpy' 2>/dev/null || { echo "skipped: numpy: no NumPy (Debian: python3-numpy)" && exit 77; }
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for variable in SLURM_ARRAY_TASK_{ID,MIN,MAX,STEP,COUNT} AWS_BATCH_JOB_ARRAY_{INDEX,SIZE} JOB_COMPLETION_INDEX \
  SGE_TASK_{ID,FIRST,LAST,STEPSIZE} PBS_ARRAY_INDEX LSB_JOBINDEX{,_END,_STEP} PARALLEL_SEQ; do
  unset "$variable"
done

result() {
  if [[ -z $2 ]]; then
    echo "PASS: $1"
    ((passed += 1))
  else
    echo "FAIL: $1: $2"
    head -n 5 said.txt
    ((failed += 1))
  fi
}

# refuses TITLE CODE WORDS ARGUMENT...: WORDS are a fixed string. `out` is the output folder of all cases.
refuses() {
  local -r title=$1 expected=$2 words=$3
  local code=0 wrong=""
  shift 3
  env "${environment[@]}" "$texremap" "$@" >/dev/null 2>said.txt || code=$?
  if [[ $code != "$expected" ]]; then
    wrong="exit code $code, not $expected"
  elif ! grep -F -- "$words" said.txt | grep -q '([^()]*.*)'; then
    wrong="no line with '$words' and a remedy in parentheses"
  elif [[ $expected == 2 && $(wc -l <said.txt) != 1 ]]; then
    wrong="more than one line"
  elif [[ $expected == 2 && -e out ]]; then
    wrong="out exists"
  elif find . -name '.*' -not -name . -not -path '*/.texremap*' | grep -q .; then
    wrong="left: $(find . -name '.*' -not -name . -not -path '*/.texremap*' | head -n 1)"
  fi
  result "$title" "$wrong"
  rm -rf out
}

# refuses_part WORD
refuses_part() { refuses "--part '$1'" 2 "'$1'" "${convert[@]}" --manifest sets.jsonl --part "$1" -o out; }

# refuses_manifest TITLE WORDS SED: a manifest that the script has edited.
refuses_manifest() {
  sed -e "$3" sets.jsonl >edited.jsonl
  ! cmp -s sets.jsonl edited.jsonl || result "$1" "the edit changes nothing"
  refuses "manifest: $1" 1 "$2" "${convert[@]}" --manifest edited.jsonl --part 1/2 -o out
  rm edited.jsonl
}

# refuses_auto TITLE WORDS PART VARIABLE=VALUE...
refuses_auto() {
  local -ra environment=("${@:4}")
  refuses "$3 with $1" 2 "$2" "${convert[@]}" --manifest sets.jsonl --part "$3" -o out
}

# takes_auto EXPECTED PART VARIABLE=VALUE...: EXPECTED is that of the report, as in 0002-of-0004.
takes_auto() {
  local -r expected=$1 part=$2
  local wrong=""
  shift 2
  env "$@" "$texremap" "${convert[@]}" --manifest one.jsonl --part "$part" -o out >said.txt 2>&1 || wrong="exit code $?"
  [[ -n $wrong || -e out/.texremap-parts/part-$expected.jsonl ]] || wrong="is $(cd out/.texremap-parts && echo ./*)"
  result "$part with $* is part $expected" "$wrong"
  rm -rf out
}

# slurm INDEX FIRST LAST [STEP]: the variables of a task of an array.
slurm() {
  local -r step=${4:-1}
  echo "SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_MIN=$2 SLURM_ARRAY_TASK_MAX=$3 SLURM_ARRAY_TASK_STEP=$step" \
    "SLURM_ARRAY_TASK_COUNT=$((($3 - $2) / step + 1))"
}

# finish MANIFEST PART: in `out`.
finish() { "$texremap" "${convert[@]}" --manifest "$1" --part "$2" -o out 2>said.txt; }

readonly second=out/.texremap-parts/part-0002-of-0002.jsonl

merge_refuses() { refuses "merge-reports: $1" 1 "$2" merge-reports out; }

/usr/bin/python3 "$here/make_sets.py" in 4
"$texremap" index in --quiet -o sets.jsonl
"$texremap" index in/region3 --quiet -o one.jsonl

for word in 0/4 5/4 -1/4 +1/4 x/4 4 '' / 1/ /4 1/0 0/0 1/4/2 ' 1/4' 1.5/4 0x1/4 99999999999999999999/4 1/99999999999999999999 \
  auto/0 auto/x auto/-1 Auto; do
  refuses_part "$word"
done
refuses "--part without a manifest" 2 "--part requires --manifest" "${convert[@]}" in --part 1/2 -o out

refuses_manifest "of another version" "edited.jsonl: is of version 9.9" '1s/"version":"[^"]*"/"version":"9.9"/'
refuses_manifest "of another format" "edited.jsonl: is " '1s/"remap_manifest":1/"remap_manifest":2/'
refuses_manifest "a letter of a name" "edited.jsonl: is incomplete, or was changed" '$s/prop00003_s/prop00004_s/'
refuses_manifest "a size" "edited.jsonl: is incomplete, or was changed" '$s/"bytes":./"bytes":9/'
refuses_manifest "a cost" "edited.jsonl: is incomplete, or was changed" '3s/"cost":./"cost":9/'
refuses_manifest "a cost that is none" "edited.jsonl: is incomplete, or was changed" '2s/"cost":./"cost":x/'
refuses_manifest "the hash" "edited.jsonl: is incomplete, or was changed" '1s/"hash":"./"hash":"x/'
refuses_manifest "the number of sets" "edited.jsonl: " '1s/"sets":4/"sets":5/'
refuses_manifest "the whole cost" "edited.jsonl: " '1s/"cost":./"cost":9/'
refuses_manifest "lines in another order" "edited.jsonl: is incomplete, or was changed" '2{h;d};3G'
refuses_manifest "a set twice" "edited.jsonl: is incomplete, or was changed" '2p'
refuses_manifest "a set less" "edited.jsonl: is incomplete, or was changed" '$d'
refuses_manifest "no line" "edited.jsonl: is no manifest" 'd'
refuses_manifest "no header" "edited.jsonl: is no manifest" '1d'
refuses_manifest "Windows' ends of lines" "edited.jsonl: " 's/$/\r/'
refuses_manifest "the root" "edited.jsonl: is incomplete, or was changed" '1s/"root":"[^"]*"/"root":"\/nowhere"/'
for bytes in 5 50 500; do
  head -c "-$bytes" sets.jsonl >cut.jsonl
  refuses "manifest: $bytes bytes less" 1 "cut.jsonl: is incomplete" "${convert[@]}" --manifest cut.jsonl --part 1/2 -o out
done
refuses "manifest: a picture" 1 "specular.png: is no manifest" "${convert[@]}" \
  --manifest in/region0/group00/prop00000/prop00000_specular.png -o out

refuses_auto "no scheduler" "SLURM_ARRAY_TASK_ID" auto
refuses_auto "two schedulers" "SLURM_ARRAY_TASK_ID=1 and SGE_TASK_ID=1" auto SGE_TASK_ID=1 $(slurm 1 1 4)
refuses_auto "steps" "steps" auto $(slurm 1 1 7 2)
refuses_auto "a piece of an array" "auto/N" auto $(slurm 7 3 7) SLURM_ARRAY_TASK_COUNT=2
refuses_auto "no size" "auto/N" auto JOB_COMPLETION_INDEX=1
refuses_auto "no size" "auto/N" auto PBS_ARRAY_INDEX=1
refuses_auto "an index that is none" "SLURM_ARRAY_TASK_ID=one" auto SLURM_ARRAY_TASK_ID=one SLURM_ARRAY_TASK_COUNT=4
refuses_auto "an index beyond" "SLURM_ARRAY_TASK_ID=5" auto/4 SLURM_ARRAY_TASK_ID=5
refuses_auto "an index below" "SLURM_ARRAY_TASK_ID=0" auto/4 SLURM_ARRAY_TASK_ID=0
refuses_auto "an index beyond" "JOB_COMPLETION_INDEX=4" auto/4 JOB_COMPLETION_INDEX=4
refuses_auto "a task of no array" "SGE_TASK_ID" auto SGE_TASK_ID=undefined

takes_auto 0003-of-0004 auto $(slurm 3 1 4)
takes_auto 0004-of-0004 auto $(slurm 3 0 3)
takes_auto 0003-of-0004 auto/4 $(slurm 3 3 3)
takes_auto 0002-of-0004 auto/4 $(slurm 2 2 3)
takes_auto 0001-of-0004 auto AWS_BATCH_JOB_ARRAY_INDEX=0 AWS_BATCH_JOB_ARRAY_SIZE=4
takes_auto 0002-of-0004 auto/4 AWS_BATCH_JOB_ARRAY_INDEX=1
takes_auto 0004-of-0004 auto/4 JOB_COMPLETION_INDEX=3
takes_auto 0002-of-0004 auto SGE_TASK_ID=2 SGE_TASK_FIRST=1 SGE_TASK_LAST=4 SGE_TASK_STEPSIZE=1
takes_auto 0002-of-0004 auto/4 SGE_TASK_ID=2
takes_auto 0004-of-0004 auto/4 PBS_ARRAY_INDEX=4
takes_auto 0001-of-0004 auto/4 LSB_JOBINDEX=1
takes_auto 0002-of-0004 auto LSB_JOBINDEX=2 LSB_JOBINDEX_END=4
takes_auto 0002-of-0004 auto/4 LSB_JOBINDEX=2 SGE_TASK_ID=undefined
takes_auto 0004-of-0004 auto/4 PARALLEL_SEQ=4
takes_auto 0001-of-0001 1/1 SLURM_ARRAY_TASK_ID=7 SGE_TASK_ID=1

for place in in in/out in/../in/region0 ./in/; do
  refuses "an output folder in the tree: $place" 2 "$place" "${convert[@]}" --manifest sets.jsonl --part 1/2 -o "$place"
done
mkdir else
refuses "a manifest of another tree" 1 "else/region0/group00/prop00000/prop00000_roughness.png" "${convert[@]}" else \
  --manifest sets.jsonl --part 1/2 -o out
cp -r in changed
"$texremap" index changed --quiet -o changed.jsonl
rm changed/region0/group00/prop00000/prop00000_roughness.png
refuses "a set that vanished" 1 "prop00000_roughness.png" "${convert[@]}" --manifest changed.jsonl --part 1/2 -o out
cp in/region0/group00/prop00000/prop00000_roughness.png changed/region0/group00/prop00000
echo more >>changed/region1/group01/prop00001/prop00001_specular.exr
refuses "a file of another size" 1 "prop00001_specular.exr: has " "${convert[@]}" --manifest changed.jsonl --part 1/2 -o out

refuses "index: a folder without sets" 2 "else: no texture set" index else -o other.jsonl
refuses "index: a manifest that is there" 1 "sets.jsonl: already exists" index in -o sets.jsonl

merge_refuses "no such folder" "out: holds no report"
mkdir out
merge_refuses "an empty folder" "out: holds no report"
finish sets.jsonl 1/2 && finish sets.jsonl 2/2 && cp -r out whole
cp -r whole out && rm "$second"
merge_refuses "a part is missing" "no report of 1 part: 2"
cp -r whole out && cp "${second/-0002-/-0001-}" "$second"
merge_refuses "a report twice" "part-0002-of-0002.jsonl: is the report of another part"
cp -r whole out && finish one.jsonl 3/3
merge_refuses "parts of two divisions" "reports of 2 and of 3 parts"
cp -r whole out && sed -i '1s/"manifest":"[^"]*"/"manifest":"of-another"/' "$second"
merge_refuses "parts of two manifests" "manifest of-another"
cp -r whole out && sed -i '1s/"options":"[^"]*"/"options":"--type half"/' "$second"
merge_refuses "parts of two conversions" "options --type half"
cp -r whole out && sed -i '$d' "$second"
merge_refuses "a report without its end" "part-0002-of-0002.jsonl: is incomplete"
cp -r whole out && sed -i 3d "$second"
merge_refuses "a set in no report" "part-0002-of-0002.jsonl: is incomplete"
cp -r whole out && truncate -s -700 "$second"
merge_refuses "a report that is cut" "part-0002-of-0002.jsonl"
cp -r whole out && : >"$second"
merge_refuses "a report without a line" "part-0002-of-0002.jsonl"
cp -r whole out && rm "$second" && finish changed.jsonl 1/2
merge_refuses "a set that failed" "prop00001_specular.exr: has "

echo "$passed passed, $failed failed"
exit "$((failed > 0))"
