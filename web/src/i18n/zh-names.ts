// 画廊场景中物体的中文名。 Names of the bodies of the gallery's scenes, which are English in their texts, in Chinese. Numbers at their end stay.
const NAMES: Record<string, string> = {
  "16-cell": "正十六胞体", "24-cell": "正二十四胞体", "5-cell": "正五胞体", "8-cell": "正八胞体", "120-cell": "正一百二十胞体", "600-cell": "正六百胞体",
  ball: "球", beam: "横梁", block: "方块", "board +w": "板 +w", "board +x": "板 +x", "board +z": "板 +z", "board −w": "板 −w", "board −x": "板 −x", "board −z": "板 −z", body: "物体", box: "方体",
  brick: "砖", bump: "凸块", capsule: "胶囊", carrier: "行星架", chassis: "底盘", "cross-polytope": "正轴形", cube: "方体", cubinder: "方圆柱", cylinder: "圆柱", disc: "圆盘", dodecahedron: "正十二面体", domino: "骨牌",
  door: "门", duocylinder: "双圆柱", end: "挡板", floor: "地面", friction: "摩擦", ground: "地面", "gold ring": "金环", guest: "来客", handle: "把手", heavy: "重物", hook: "钩", knot: "结", light: "轻物", link: "链节",
  lower: "下杆", marble: "弹珠", octahedron: "正八面体", parcel: "包裹", pea: "豌豆", pin: "球瓶", plank: "木板", plate: "板", post: "支柱", restitution: "弹性", ring: "环", rod: "杆", "silver ring": "银环",
  simplex: "单纯形", slope: "斜坡", spherinder: "球柱", steady: "稳定", step: "台阶", sun: "太阳轮", tesseract: "超正方体", thing: "物体", toy: "玩具", tumbling: "翻滚", upper: "上杆", whisk: "搅拌器", "wrecking ball": "铁球",
  "behind, along w": "w 后方", "in front, along w": "w 前方", "first belt": "第一条传送带", "second belt": "第二条传送带", "rear left wheel": "左后轮", "rear right wheel": "右后轮", "front left wheel": "左前轮",
  "front right wheel": "右前轮", "ball: never": "球：过不去", "flat in w: fits": "在 w 里薄：能过", "flat in x: turn it": "在 x 里薄：先转一转", "spherinder: upright": "球柱：竖着过",
  "xw alone: tumbles": "只在 xw：翻滚", "yz alone: steady": "只在 yz：稳定", "xy and zw: steady": "xy 与 zw：稳定", "xz and yw: tumbles": "xz 与 yw：翻滚",
};

export function zhName(name: string): string {
  const [, word, number] = /^(.*?)((?: [\d.]+)*)$/.exec(name) ?? [];
  const known = NAMES[name] ?? NAMES[word] ?? NAMES[word.toLowerCase()];
  return known === undefined ? name.replace(/^(far|near) (\w) wall$/, (_, side: string, axis: string) => `${axis} ${side === "far" ? "远" : "近"}墙`) : known + (NAMES[name] ? "" : number);
}
