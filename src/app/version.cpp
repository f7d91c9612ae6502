// The version of the toolkit, as run records name it.
#include "app/version.h"
