#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace cdcr::test {

/// Makes a call in a process of its own, silently: the signal that ends it, or 0.
template <class Call>
int signal_of(Call&& call) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int caught : {SIGABRT, SIGSEGV}) std::signal(caught, SIG_DFL);  // doctest's are not
    const rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(2);
    call();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace cdcr::test
