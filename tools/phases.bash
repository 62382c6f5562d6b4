# For scripts to source: phases of work, a line each with its time. What their commands print goes to a log and is shown only
# where one fails; meanwhile a terminal has the log's last line, anything else a dot every ten seconds.
#   begin_log FILE
#   phase NAME WHAT COMMAND...      fails where the command does

begin_log() {
  log=$1
  mkdir -p "$(dirname "$log")"
  : >"$log"
  trap stop_watching EXIT
}

stop_watching() {
  [ -z "${watcher:-}" ] || kill "$watcher" 2>/dev/null || true
  watcher=
}

watch_log() {
  local name=$1 start=$2 columns last
  if [ ! -t 1 ]; then
    while sleep 10 </dev/null >/dev/null 2>&1; do printf .; done
    return
  fi
  columns=$(tput cols 2>/dev/null || echo 80)
  while sleep 1 </dev/null >/dev/null 2>&1; do
    last=$(tail -c 2000 "$log" | tr '\r\t' '\n ' | tr -cd '[:print:]\n' | grep -v '^ *$' | tail -n 1 || true)
    last=$(printf '  %-7s %d s  %s' "$name" $((SECONDS - start)) "$last")
    printf '\r\033[K%s' "${last:0:$((columns - 1))}"
  done
}

phase() {
  local name=$1 label start=$SECONDS code=0 from
  label=$(printf '  %-7s %-38s' "$name" "$2")
  shift 2
  printf '== %s\n' "$*" >>"$log"
  from=$(stat -c %s "$log")
  printf '%s ' "$label"
  { watch_log "$name" "$start" & } 2>/dev/null
  watcher=$!
  "$@" </dev/null >>"$log" 2>&1 || code=$?
  kill "$watcher"
  wait "$watcher" 2>/dev/null || true
  watcher=
  [ ! -t 1 ] || printf '\r\033[K%s ' "$label"
  if [ "$code" -eq 0 ]; then
    printf '%5d s\n' $((SECONDS - start))
    return 0
  fi
  printf '%5d s  FAILED; the end of what it said:\n\n' $((SECONDS - start))
  tail -c +$((from + 1)) "$log" | tail -n 40
  printf '\nAll of it is in %s\n' "$log"
  return 1
}
