#include "experiments/harness/cells.h"
