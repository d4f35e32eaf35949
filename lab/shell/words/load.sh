# Reads the words of the language that GRADER_LANG names; without one, or an unknown one, English.
lab_words=/opt/ros2_teaching_lab/lab/shell/words
lab_language="${GRADER_LANG:-en}"
lab_language="${lab_language%%[_.@]*}"
[ -r "$lab_words/$lab_language.sh" ] || lab_language=en
. "$lab_words/$lab_language.sh"
