// Deferred shading in which all lights throw smooth shadows by moment shadow maps, which are blurred once.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "prefiltered", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("PrefilteredShadows", {kernel: 11});
pass("TileLights");
pass("TiledLighting", {shadows: "prefiltered"});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
