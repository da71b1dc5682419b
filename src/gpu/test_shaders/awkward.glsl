// Text that CMake could spoil: [ ; ] [[ ]] ]=] ${NOT_A_VARIABLE} @NOT_ONE_EITHER@ $ENV{HOME} "quoted" \n \\ ;; 100%
#define JOINED(a, b) \
  a[b]
float values[3] = float[](1.0, 2.0, 3.0);;
// no newline at the end: ]
// [