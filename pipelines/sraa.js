// The deferred picture with smooth edges: surfaces are drawn at four places in each pixel, shaded at one.
// GeometrySamples.geometry=depth is cheaper and finds outlines only.
pipeline({name: "sraa", output: "Sraa.color"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
pass("GeometrySamples");
pass("Sraa");
