// The deferred picture, darker towards its corners. Needs the plugin beside this file.
pipeline({name: "vignette"});

pass("Cull");
pass("GBuffer");
pass("Lighting");
pass("CustomShaders");
pass("Background");
pass("Transparency");
pass("Vignette", {strength: 0.9});
pass("ToneMap");
