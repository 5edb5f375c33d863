// What pointers, the wheel and the keyboard mean to a view.
//
//     left drag, one finger     turn about the point under the pointer; on a handle: drag it
//     right or middle drag, shift + left drag, two fingers     move
//     wheel, pinch              closer or farther, towards the pointer
//     click                     pick;  double click: turn about this point from now on
//     arrows                    turn;  with shift: move;  + and -: closer, farther;  F: show all

export type Actions = {
  /** A pointer goes down. `reach`: how far from a handle it may be, in pixels. */
  press(x: number, y: number, reach: number): 'camera' | 'handle';
  /** Takes hold of the middle of the model, for keys. */
  grabMiddle(): void;
  /** The pressed handle goes to a position. */
  drag(x: number, y: number): void;
  /** The pointer that was pressed goes up. */
  release(): void;
  /** The pointer is over a position; returns the name of the handle there, if any. */
  hover(x: number, y: number, reach: number): string | null;
  click(x: number, y: number): void;
  orbit(yaw: number, pitch: number): void;
  pan(x: number, y: number): void;
  dolly(x: number, y: number, factor: number): void;
  setPivot(x: number, y: number): void;
  frameAll(): void;
};

type Point = { x: number; y: number };
type Mode = 'idle' | 'click' | 'orbit' | 'pan' | 'handle' | 'pinch';

/** Radians a pixel: half a turn in 450 pixels. */
const ORBIT_SPEED = Math.PI / 450;
/** Pixels that a click may wander. */
const CLICK_SLACK = { mouse: 4, touch: 10 };
/** How far from a handle a pointer may be. */
const REACH = { mouse: 12, touch: 24 };
/** Share by which a key press changes the distance, and pixels or radians by which it moves or turns. */
const KEY_ZOOM = 0.8;
const KEY_PAN = 40;
const KEY_TURN = Math.PI / 24;

/** The factor of the distance to the model that a turn of the wheel asks for. */
export function wheelFactor(delta: number, mode: number, isPinch: boolean): number {
  const pixels = delta * ([1, 16, 400][mode] ?? 1);
  // Trackpads report a pinch as a wheel with ctrl and small steps.
  return Math.exp(Math.max(-240, Math.min(240, pixels)) * (isPinch ? 0.01 : 0.0018));
}

/** How two fingers moved: the middle between them by how much, and how much closer they are together. */
export function pinch(before: [Point, Point], after: [Point, Point]): { middle: Point; by: Point; factor: number } {
  const middleOf = ([a, b]: [Point, Point]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
  const spread = ([a, b]: [Point, Point]) => Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1);
  const [from, to] = [middleOf(before), middleOf(after)];
  return { middle: to, by: { x: to.x - from.x, y: to.y - from.y }, factor: spread(before) / spread(after) };
}

const kindOf = (event: PointerEvent) => (event.pointerType === 'touch' ? 'touch' : 'mouse');

/** Turns what happens on the canvas into actions until the signal aborts. */
export function listenForGestures(canvas: HTMLCanvasElement, actions: Actions, signal: AbortSignal): void {
  canvas.style.touchAction = 'none';
  if (canvas.tabIndex < 0) canvas.tabIndex = 0;
  const pointers = new Map<number, Point>();
  let mode: Mode = 'idle';
  let start: Point = { x: 0, y: 0 };
  let pans = false;

  const position = (event: MouseEvent): Point => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const listen = <K extends keyof HTMLElementEventMap>(type: K, react: (event: HTMLElementEventMap[K]) => void) =>
    canvas.addEventListener(type, react, { signal, passive: false });

  listen('pointerdown', (event) => {
    const at = position(event);
    pointers.set(event.pointerId, at);
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size > 1) {
      if (mode === 'handle') return;
      mode = 'pinch';
      return;
    }
    start = at;
    pans = event.button !== 0 || event.shiftKey;
    const onHandle = actions.press(at.x, at.y, REACH[kindOf(event)]) === 'handle';
    mode = onHandle ? 'handle' : 'click';
    canvas.style.cursor = onHandle ? 'grabbing' : '';
  });

  listen('pointermove', (event) => {
    const at = position(event);
    const last = pointers.get(event.pointerId);
    if (!last) {
      canvas.style.cursor = actions.hover(at.x, at.y, REACH[kindOf(event)]) ? 'grab' : '';
      return;
    }
    const wandered = Math.hypot(at.x - start.x, at.y - start.y);
    if (mode === 'click' && wandered > CLICK_SLACK[kindOf(event)]) {
      mode = pans ? 'pan' : 'orbit';
      canvas.style.cursor = pans ? 'move' : 'grabbing';
    }
    const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, other]) => other);
    pointers.set(event.pointerId, at);
    const [dx, dy] = [at.x - last.x, at.y - last.y];
    if (mode === 'handle') actions.drag(at.x, at.y);
    else if (mode === 'orbit') actions.orbit(-dx * ORBIT_SPEED, -dy * ORBIT_SPEED);
    else if (mode === 'pan') actions.pan(dx, dy);
    else if (mode === 'pinch' && others[0]) {
      const { middle, by, factor } = pinch([last, others[0]], [at, others[0]]);
      actions.pan(by.x, by.y);
      actions.dolly(middle.x, middle.y, factor);
    }
  });

  const lift = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId) || pointers.size > 0) return;
    const isClick = mode === 'click' && event.type === 'pointerup' && event.button === 0;
    mode = 'idle';
    canvas.style.cursor = '';
    actions.release();
    if (isClick) actions.click(start.x, start.y);
  };
  listen('pointerup', lift);
  listen('pointercancel', lift);
  listen('contextmenu', (event) => event.preventDefault());

  listen('dblclick', (event) => {
    const at = position(event);
    actions.setPivot(at.x, at.y);
  });

  listen('wheel', (event) => {
    event.preventDefault();
    const at = position(event);
    actions.dolly(at.x, at.y, wheelFactor(event.deltaY, event.deltaMode, event.ctrlKey));
  });

  listen('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = keyAction(event.key, event.shiftKey, canvas, actions);
    if (!act) return;
    event.preventDefault();
    act();
  });
}

/** What a key does, if it means anything to a view. */
export function keyAction(
  key: string,
  shift: boolean,
  canvas: { clientWidth: number; clientHeight: number },
  actions: Actions,
): (() => void) | undefined {
  const middle = { x: canvas.clientWidth / 2, y: canvas.clientHeight / 2 };
  const arrows: Record<string, [number, number]> = {
    ArrowLeft: [1, 0],
    ArrowRight: [-1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  const arrow = arrows[key];
  if (arrow) {
    const [x, y] = arrow;
    return () => {
      actions.grabMiddle();
      if (shift) actions.pan(x * KEY_PAN, y * KEY_PAN);
      else actions.orbit(x * KEY_TURN, y * KEY_TURN);
      actions.release();
    };
  }
  if (key === '+' || key === '=') return () => actions.dolly(middle.x, middle.y, KEY_ZOOM);
  if (key === '-' || key === '_') return () => actions.dolly(middle.x, middle.y, 1 / KEY_ZOOM);
  if (key === 'f' || key === 'F') return () => actions.frameAll();
  return undefined;
}
