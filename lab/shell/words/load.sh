# Reads the texts in the language of GRADER_LANG; English if it is unset or unknown.
lab_words=/opt/ros2_teaching_lab/lab/shell/words
lab_language="${GRADER_LANG:-en}"
lab_language="${lab_language%%[_.@]*}"
[ -r "$lab_words/$lab_language.sh" ] || lab_language=en
. "$lab_words/$lab_language.sh"

# Prints a text as printf does; on a terminal its lines are broken at words. What four spaces precede can
# be copied: it is never broken. (In bytes: a Korean letter counts three instead of two columns.)
lab_say() {
  if [ ! -t 1 ] || ! command -v awk > /dev/null; then
    printf "$@"
    return
  fi
  printf "$@" | LC_ALL=C awk -v "size=$(stty size 2> /dev/null < /dev/tty)" '
    BEGIN { split(size, of, " "); width = of[2] >= 20 ? of[2] : 80 }
    /^    / || length($0) <= width { print; next }
    {
      match($0, /^ */)
      lead = line = substr($0, 1, RLENGTH)
      count = split($0, words, " ")
      for (n = 1; n <= count; n++) {
        if (line != lead && length(line) + 1 + length(words[n]) > width) { print line; line = lead }
        line = line (line == lead ? "" : " ") words[n]
      }
      print line
    }'
}
