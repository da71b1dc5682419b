// Deferred shading in which all lights throw shadows with penumbrae, by moment shadow maps that are blurred once.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "prefiltered", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("PrefilteredShadows", {penumbra: "light", kernel: 5});
pass("TileLights");
pass("TiledLighting", {shadows: "prefiltered"});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
