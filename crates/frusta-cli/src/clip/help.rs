//! The text of `frusta clip --help` after the flags.

/// The end of `-h`.
pub(super) const HELP_END: &str = "More with --help: formats, examples, exit codes.";

/// The end of `--help`, before the exit codes.
pub(super) const FORMATS: &str = "\
Input
  A file, or - for the standard input; the format by the name or --from.
  .glb .gltf  The default scene's line (mode 1 to 3) or triangle (mode 4 to 6) primitives through
              all node transforms, in double precision. Sparse accessors, quantized
              positions, data URIs and buffer files work; skins and morph targets are not applied.
  .obj        v, l and f. A polygon counts as its outline. With --edges lines its l elements are a
              stream, and only the vertices are kept in memory.
  .stl        Text or binary, recognised by the file's length. Text is read word by word. Triangle
              edges.
  .ply        Text or binary: edge elements, or the outlines of faces and triangle strips.
  .csv        x0,y0,z0,x1,y1,z1, decimal or hexadecimal (0x1.8p-3); a stream. With a header the
              columns are found by name among others. A row is a line. Lines that begin with # are
              comments.
  .geojson    Line strings and the rings of polygons of a geometry, a feature or a collection, which
  .json       is a stream of features; points are passed over. Longitude, latitude and height are
              x, y and z, or with --ecef a place on the WGS 84 ellipsoid, in earth-centred metres.
  .geojsonl   The same of many JSON texts, one after the other; also .geojsons, .ndjson.
  With --edges triangles each edge of a mesh comes once, wherever its vertices are split.
  A coordinate that is infinite or NaN is an error. A stream takes the same memory however long it
  is (GeoJSON: that of its largest feature). To clip a pipe, give the camera: the extent of a
  pipe is not known beforehand.

The earth (--ecef)
  From above, the earth's far side is in front of a camera, too, and only a far face cuts it off.
  --over LON,LAT,HEIGHT is a camera that looks down from a place in degrees and metres, north
  upwards, against the normal of the plane through its horizon. That plane is its far face: inside
  is everything on this side of the horizon; from less than 25 km up the sides, at most 170 degrees
  apart, cut some of it off. --fovy, --aspect, --near and --far change the camera.

Output
  A file, or - for the standard output, in which case the statistics go to the error stream; the
  format by the name or --to. A file is written whole or not at all: under a temporary name in the
  same folder, then renamed. A run that fails or is interrupted leaves nothing. Devices and pipes
  are written directly.
  .csv  index,class,t0,t1,x0,y0,z0,x1,y1,z1,enter,leave,coplanar; a row a segment, in the input's
        order. class: outside, touch, boundary, inside or cross; t0..t1: the part's parameters;
        enter, leave, coplanar: faces joined by + (near far left right bottom top) whose planes
        contain the entry point, the exit point, the whole segment. Numbers read back to the same
        bits. For outside the fields after class are empty.
  .obj  two vertices and a line element for each part; a vertex and a point element for a touch.
        Indices count back.
  .glb  glTF binary with a line for each part (a point for a touch), a material for each class; in
        single precision, relative to the node's translation where the frustum is far away.
  .svg .png  a picture; a PNG is the SVG, rasterised. --picture camera: what the camera sees, from
        the near rectangle's side, hidden lines included. --picture outside: the frustum and the
        scene around it from the frustum's right, behind and above, in parallel projection; a
        frustum much deeper than the scene is drawn open, as far as the scene goes. A view more than
        8 times as wide as high, or as high as wide, is squeezed to that. Up to 20,000 strokes are
        drawn one by one. More are summed up by pixel: a place's tone is its rank
        among all others (histogram equalisation), clipped edges and cut points lie on top.

Statistics (a table, or --json), among others
  filter_failure_share  the share of segments with a sign that the floating-point filter did not
        decide; a later stage did, double-double included. stages has their number, and the number
        of signs and values from each later stage. Null for --arithmetic plain.
  not_inward  clipped points that are not proven inside: all, except with --accuracy inward.
  view.deviation  for a frustum from a matrix: the distance of its vertices from the matrix's exact
        clip volume; sides in X / W and Y / W, near and far as fractions of their distances.

Frustum files (--frustum); any number may be a text with a hexadecimal float
  {\"origin\":[0,0,0], \"axes\":[[1,0,0],[0,1,0],[0,0,1]],
   \"near\":{\"z\":-1,\"left\":-1,\"right\":1,\"bottom\":-1,\"top\":1}, \"far\":{...}}
  the same with \"slopes\":{\"left\":-1,\"right\":1,\"bottom\":-1,\"top\":1}, \"direction\":1 instead of
   \"far\": no far face; the sides' bounds change by the slopes for each unit of depth
  {\"eye\":[0,0,5], \"target\":[0,0,0], \"up\":[0,1,0], \"fovy_deg\":45 or \"ortho_height\":2,
   \"aspect\":1.5, \"near\":0.1, \"far\":100 or \"inf\"}
  {\"matrix\":[16 numbers], \"layout\":\"column-major\" or \"row-major\", \"depth\":\"0..1\" or \"-1..1\",
   \"reversed\":false, \"y\":\"up\" or \"down\", \"precision\":\"f64\" or \"f32\"}: view and projection,
   for column vectors; the last three keys may be left out

Examples
  frusta clip part.glb
      which edges a default camera takes in; prints the flags that give the same camera again
  frusta clip part.glb --up 0,-1,0 -o view.svg
      a picture, for a model whose y points downwards
  frusta clip part.glb --picture outside --theme dark -o frustum.png
      which edges the camera takes in, seen from outside
  frusta clip coast.geojson --ecef --over 10,50,1e6 -o europe.png
      everything on this side of the horizon, from 1000 km above 10 degrees east and 50 north
  generator | frusta clip - --from csv --frustum view.json -o - --to csv | consumer
      in constant memory
  frusta clip edges.csv --eye 0,0,5 --target 0,0,0 --near 1 --far inf -o clipped.csv
      every row's part in an infinite frustum
  frusta clip edges.csv --frustum view.json --accuracy inward --json
      statistics, with clipped points that are never outside, where any representable point near
      is inside; the rest are counted (not_inward)
";
