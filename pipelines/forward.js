// Plain forward rendering of the same materials and lights: the baseline that `deferred` is compared
// with in picture and time.
pipeline({name: "forward", output: "ToneMap.color"});

pass("Cull");
pass("Forward");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
