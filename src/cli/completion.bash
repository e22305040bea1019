# Completion for bash of rsphere and its companions, and of rtrace and rcontrib where they are rsphere's: their options as
# "-help all" lists them, which comes from the table that the program reads them by; and files. It is installed under each name.
_rsphere() {
  local word=${COMP_WORDS[COMP_CWORD]} program
  COMPREPLY=()
  program=$(type -P "${1/#\~\//${HOME-}/}") || return
  # Another one is neither run nor known; bash completes files for it, as it does without this function.
  [[ ${program##*/} != r[tc]* || $(readlink -f "$program") == */rsphere ]] || return
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "-version -help -defaults $("$program" -help all 2>/dev/null |
      sed -n 's/^ *\(-[A-Za-z][A-Za-z]*\).*/\1/p')" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames 2>/dev/null
  fi
}
complete -o bashdefault -o default -F _rsphere rsphere rsphere-compare rsphere-trade rtrace rcontrib
