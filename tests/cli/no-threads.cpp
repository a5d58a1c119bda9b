// Loaded before a program: its threads cannot be made, as where a limit on processes is reached. Root has no such
// limit.
#include <errno.h>
#include <pthread.h>

extern "C" int pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) { return EAGAIN; }
