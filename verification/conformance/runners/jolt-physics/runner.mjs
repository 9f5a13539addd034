// Jolt Physics: a convex hull of three points against a mesh of one triangle.
import load from 'jolt-physics/wasm-compat';
import { serve } from './common.mjs';

const J = await load();
const settings = new J.JoltSettings();
const layers = new J.ObjectLayerPairFilterTable(1);
layers.EnableCollision(0, 0);
const broad = new J.BroadPhaseLayerInterfaceTable(1, 1);
broad.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
settings.mObjectLayerPairFilter = layers;
settings.mBroadPhaseLayerInterface = broad;
settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(broad, 1, layers, 1);
const system = new J.JoltInterface(settings).GetPhysicsSystem();
const bodies = system.GetBodyInterface();
const query = system.GetNarrowPhaseQuery();
const filters = [new J.BroadPhaseLayerFilter(), new J.ObjectLayerFilter(), new J.BodyFilter(), new J.ShapeFilter()];
const one = new J.Vec3(1, 1, 1);
const zero = new J.RVec3(0, 0, 0);
const collide = new J.CollideShapeSettings();
const cast = new J.ShapeCastSettings();
collide.mBackFaceMode = J.EBackFaceMode_CollideWithBackFaces;
cast.mBackFaceModeTriangles = cast.mBackFaceModeConvex = J.EBackFaceMode_CollideWithBackFaces;

function built(settings) {
  const result = settings.Create();
  if (result.HasError()) throw new Error(result.GetError().c_str());
  return result.Get();
}

function mesh(x, i) {
  const list = new J.TriangleList();
  list.resize(1);
  for (let k = 0; k < 3; k++) {
    const corner = list.at(0).get_mV(k);
    [corner.x, corner.y, corner.z] = x.slice(3 * (i + k), 3 * (i + k) + 3);
  }
  return built(new J.MeshShapeSettings(list, new J.PhysicsMaterialList()));
}

function hull(x, i) {
  const made = new J.ConvexHullShapeSettings();
  made.mMaxConvexRadius = 0;
  for (let k = i; k < i + 3; k++) made.mPoints.push_back(new J.Vec3(...x.slice(3 * k, 3 * k + 3)));
  return built(made);
}

let old = null;
function placed(x) {
  if (old) {
    bodies.RemoveBody(old);
    bodies.DestroyBody(old);
    old = null;
  }
  const [a, b] = [mesh(x, 0), hull(x, 3)];
  const creation = new J.BodyCreationSettings(a, zero, new J.Quat(0, 0, 0, 1), J.EMotionType_Static, 0);
  old = bodies.CreateBody(creation).GetID();
  bodies.AddBody(old, J.EActivation_DontActivate);
  return [b, J.RMat44.prototype.sTranslation(b.GetCenterOfMass())];
}

await serve('1.1.0', {
  triangles: ({ x }) => {
    const [shape, place] = placed(x);
    return () => {
      const found = new J.CollideShapeAnyHitCollisionCollector();
      query.CollideShape(shape, one, place, collide, zero, found, ...filters);
      return [found.HadHit(), null];
    };
  },
  'moving-triangle': ({ x }) => {
    const [shape, place] = placed(x);
    const moving = new J.RShapeCast(shape, one, place, new J.Vec3(...x.slice(18, 21)));
    return () => {
      const found = new J.CastShapeClosestHitCollisionCollector();
      query.CastShape(moving, cast, zero, found, ...filters);
      return found.HadHit() ? [true, found.mHit.mFraction] : [false, null];
    };
  },
});
