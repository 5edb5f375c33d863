//! Examples of each command, for its long help.

pub(super) const REFINE: &str = "\
Examples:
  No edge longer than 2 model units, for ParaView:
    hexmill refine part.obj -o part.vtu --edge-length 2

  Twice finer everywhere, whatever the size (each level halves the edges):
    hexmill refine part.obj -o fine.obj --levels 1

  Edges of 5, but of 0.5 in a ball of radius 10 around the origin:
    hexmill refine part.obj -o part.vtu --edge-length 5 --region sphere:0,0,0,10:h=0.5

  Three levels in a box, four along a bore, everything else as coarse as it gets:
    hexmill refine part.obj -o part.msh \\
      --region box:0,0,0,10,10,5:level=3 --region cylinder:5,5,-1,5,5,6,2:level=4

  A box turned by 30 degrees about z (about x, then y, then z, through its centre):
    hexmill refine part.obj -o part.vtu --region box:0,0,0,10,2,2,0,0,30:h=0.2

  Near the nodes of one mesh and within 1.5 of the surface of another:
    hexmill refine part.obj -o part.vtu --region points:probes.obj,0.5:level=4 \\
      --region surface:shock.obj,1.5:h=0.25

  Hexes around a hull (see hexmill grid), three levels deep at its surface:
    hexmill refine sea.vtu -o fine.vtu --method two --region surface:hull.obj,0:level=3

  How many hexes that would be, and what the method adds, without making them:
    hexmill refine sea.vtu --plan --method two --region surface:hull.obj,0:level=3

  Follow curvature, ten degrees an edge, and keep a record:
    hexmill refine part.obj -o part.vtu --curvature 10 --report part.json

Regions are KIND:NUMBERS:h=SIZE (no edge longer than SIZE in it) or KIND:NUMBERS:level=N (N levels
deep; the input is level 0):
  box:x0,y0,z0,x1,y1,z1              from corner to corner
  box:x0,y0,z0,x1,y1,z1,ax,ay,az     turned about x, y and z (fixed axes, degrees, in this order)
  box:x0,y0,z0,x1,y1,z1,qx,qy,qz,qw  turned by a quaternion
  sphere:cx,cy,cz,r
  cylinder:ax,ay,az,bx,by,bz,r       capped, from a to b
  points:FILE,r                      within r of a node of FILE
  surface:FILE,d                     within d of a face of FILE
Corners of a box come in any order. What has no thickness, a flat box, r or d of 0 about nodes and faces, refines the
elements that it lies in; a cylinder with one point for both ends is a sphere. Other radii are above 0.";

pub(super) const HEX: &str = "\
Examples:
  Edges of about 2 model units, for ParaView:
    hexmill hex part.obj -o part.vtu --edge-length 2

  Surfaces meet where faces turn by more than 20 degrees; a record of what came of each feature:
    hexmill hex part.obj -o part.msh -e 2 --feature-angle 20 --report part.json

  Smaller hexes along a bore (regions as for hexmill refine), and wherever mesh and solid are more than 0.05 apart:
    hexmill hex part.obj -o part.vtu -e 2 --region cylinder:5,5,-1,5,5,6,2:h=0.5 --max-distance 0.05";

pub(super) const CHECK: &str = "\
Exit code 1 if the mesh is not conforming (repeated or hanging nodes, faces twice, ...). Open borders,
non-manifold edges and the like are noted, but are no reason to refuse.

Examples:
  hexmill check part.vtu
  hexmill check part.vtu --surface part.obj      how far the mesh and the surface are from each other
  hexmill check part.vtu --report part.json      everything, as JSON";

pub(super) const CONVERT: &str = "\
Examples:
  hexmill convert part.obj -o part.vtu
  hexmill convert part.mesh -o part.inp";

pub(super) const GRID: &str = "\
The grid runs along the axes, with the mesh in its middle.

Examples:
  hexmill grid hull.obj --spacing 0.5 -o sea.vtu                 cubes of edge 0.5
  hexmill grid hull.obj --spacing 0.5 --margin 4 -o sea.vtu      reaching 4 beyond the hull at least
  hexmill grid hull.obj --spacing 0.5 --margin 4 --fit -o sea.vtu    and no farther: edges up to 0.5";

pub(super) const QUAD: &str = "\
The polygons of IN lie in one plane, any plane. Their common outline and their holes are kept, and so are the polylines
(OBJ l lines) in it: edges of the quads follow them. Corners of more than 40 degrees are nodes, and so are nodes with a
sharpness (OBJ t corner).

Examples:
  hexmill quad plate.obj -o quads.vtu --edge-length 0.5";
