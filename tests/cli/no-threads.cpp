// Loaded before a program: its threads cannot be made, and no process where NO_PROCESSES is set, as where a limit on
// processes is reached. Root has no such limit.
#include <errno.h>
#include <pthread.h>
#include <spawn.h>
#include <stdlib.h>

#include <dlfcn.h>

extern "C" int pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) { return EAGAIN; }

extern "C" int posix_spawn(pid_t* child, const char* path, const posix_spawn_file_actions_t* actions,
                           const posix_spawnattr_t* attributes, char* const argv[], char* const envp[]) {
  if (getenv("NO_PROCESSES")) return EAGAIN;
  return reinterpret_cast<decltype(&posix_spawn)>(dlsym(RTLD_NEXT, "posix_spawn"))(child, path, actions, attributes,
                                                                                     argv, envp);
}
