// OpenGL for the .cpp files of gpu/, and only for them.
#pragma once

#include <epoxy/gl.h>
