# Reads the texts in the language of GRADER_LANG; English if it is unset or unknown.
lab_words=/opt/ros2_teaching_lab/lab/shell/words
lab_language="${GRADER_LANG:-en}"
lab_language="${lab_language%%[_.@]*}"
[ -r "$lab_words/$lab_language.sh" ] || lab_language=en
. "$lab_words/$lab_language.sh"
