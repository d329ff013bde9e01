#!/bin/sh
# undefined.sh libents.so: nothing that ends, interrupts, prints into or reconfigures the host's process is called from the library.
set -eu
library=$1
undefined=$(nm -D --undefined-only "$library" | awk '{ print $NF }' | sed 's/@.*//')
[ -n "$undefined" ] || { echo "no undefined symbol found in $library" >&2; exit 1; }
bad=0

# deny "why" 'pattern of symbols'
deny() {
  for symbol in $(printf '%s\n' "$undefined" | grep -E "^($2)\$"); do
    echo "$symbol: $1" >&2
    bad=1
  done
}

deny "ends the host's process" \
  'exit|_exit|_Exit|quick_exit|at_quick_exit|abort|__assert_fail|__assert|raise|kill|tgkill|__stack_chk_fail_local'
deny "jumps over the host's frames" '_?_?(sig)?longjmp(_chk)?|_?_?(sig)?setjmp'
deny "changes how the host handles signals" 'signal|sigaction|sigprocmask|pthread_sigmask|sigaltstack|__sysv_signal|alarm|setitimer'
deny "changes the host's locale" 'setlocale|uselocale|newlocale|_ZNSt6locale6globalERKS_'
deny "makes results depend on the environment, or changes it" \
  '(secure_|__secure_)?getenv|setenv|putenv|unsetenv|clearenv|chdir|fchdir|umask'
deny "prints into the host's output" \
  'v?printf|v?fprintf|v?dprintf|__v?f?d?printf_chk|puts|putchar|_IO_putc|putc|fputs|fputc|fwrite|perror|syslog|stdout|stderr|write'
deny "prints into the host's output, or initialises its streams" '_ZSt4c(out|err|log)|_ZSt5wc(out|err|log)|_ZNSt8ios_base4InitC1Ev'
deny "uses the host's random numbers" 's?rand(om)?(_r)?|s?rand48|drand48|rand_r'
deny "starts other programs, threads or libraries" 'system|popen|p?v?fork|execv[pe]*|posix_spawnp?|pthread_create|dlopen|dlmopen'
deny "changes the host's floating-point environment for good" 'feenableexcept|fedisableexcept|__setfpucw|_FPU_SETCW'
deny "installs a handler of the C++ runtime" '_ZSt13set_terminatePFvvE|_ZSt15set_new_handlerPFvvE|_ZSt14set_unexpectedPFvvE'

[ $bad -eq 0 ] || exit 1
echo "$(printf '%s\n' "$undefined" | wc -l) undefined symbols, none denied"
