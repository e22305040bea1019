# Completion for bash of rsphere, rtrace where it is rsphere's, and the companions: their options as -help lists them,
# which comes from the table that the program reads them by; and files.
_rsphere() {
  local word=${COMP_WORDS[COMP_CWORD]} program
  COMPREPLY=()
  program=$(type -P "$1") || return
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "-version -help -defaults $("$program" -help 2>/dev/null |
      sed -n 's/^ *\(-[A-Za-z][A-Za-z]*\).*/\1/p')" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames 2>/dev/null
  fi
}
complete -F _rsphere rsphere rsphere-compare rsphere-trade
