#include "experiments/harness/sweep-file.h"
