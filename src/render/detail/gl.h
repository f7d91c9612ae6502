// OpenGL as OSMesa links it: core prototypes without a function loader. The core header comes first.
#pragma once

#define GL_GLEXT_PROTOTYPES 1
#include <GL/glcorearb.h>
// Separated, so that sorting includes keeps this order.
#include <GL/osmesa.h>
