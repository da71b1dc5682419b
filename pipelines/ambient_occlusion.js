// The deferred picture whose ambient light is kept out of corners and creases.
// ScreenSpaceAo's radius is in metres: set it to the scene's scale.
pipeline({name: "ambient_occlusion", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("ScreenSpaceAo");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
