// 场景文本中的错误。 What is wrong with a scene's text, in Chinese: the engine says it in English, as "place: what", and the common
// sentences are known here. One that is not known is given as it is, after the place.
const KNOWN: readonly (readonly [RegExp, string])[] = [
  [/^unknown key "(.*?)"; the nearest known one is "(.*?)" \(known: (.*)\)$/, "没有“$1”这个键，最接近的是“$2”（可用：$3）"],
  [/^has no "(.*?)", which it needs$/, "缺少必需的“$1”"],
  [/^has no "format"; a scene starts with (.*)$/, "缺少“format”；场景以 $1 开头"],
  [/^is (.+?), expected (.+?)(?:; the nearest is "(.*)")?$/, "是 $1，应为 $2"],
  [/^has (\d+) numbers?, expected (\d+).*$/, "有 $1 个数，应为 $2 个"],
  [/^(?:the )?(.+?) is (\S+): it must be a number of metres between (\S+) and (\S+)$/, "$1 是 $2，必须是 $3 到 $4 之间的米数"],
  [/^is (.+?); it has to lie within (.+)$/, "是 $1，必须在 $2 之内"],
  [/^unknown plane "(.*?)"; in (\d) dimensions there are (.*)$/, "没有平面“$1”；$2 维空间里有 $3"],
  [/^no (?:body|material) is called "(.*?)"; (?:there are|the nearest is) (.*)$/, "没有名为“$1”的；现有或最接近的是 $2"],
  [/^there is no regular polytope "(.*?)" in (\d) dimensions; .*? in \d dimensions there are (.*?), and their .*$/, "$2 维中没有正多胞形“$1”，有 $3"],
  [/^"(.*?)" is already the name of (.*); names have to differ$/, "名称“$1”已被 $2 使用"],
  [/^not JSON: trailing comma$/, "多了一个逗号"],
  [/^not JSON: EOF .*$/, "文本不完整，像是被截断了"],
  [/^not JSON: a key has to be a string in double quotes$/, "不是 JSON：键必须是双引号里的字符串"],
  [/^not JSON: expected (.*)$/, "不是 JSON：此处应为 $1"],
  [/^not JSON: (.*)$/, "不是 JSON：$1"],
];

const TERMS: readonly (readonly [RegExp, string])[] = [
  [/\ba whole number from (\d+) to (\d+)/g, "$1 到 $2 的整数"], [/\ba whole number\b/g, "整数"], [/\ba number from (\S+) to (\S+)/g, "$1 到 $2 的数"], [/\ba number\b/g, "数"], [/\ba string(?: in quotes)?/g, "字符串"], [/\ba list(?: of numbers)?/g, "列表"], [/\ban? object\b/g, "对象"], [/\bvalue\b/g, "值"],
  [/\bradius\b/g, "半径"], [/\bhalf-extent\b/g, "半长"], [/ of an? (\w+)/g, "（$1）"], [/ or /g, " 或 "],
];

/** The engine's words about a scene, in Chinese as far as they are known. */
export function zhProblem(message: string): string {
  const [, place, what] = /^((?:line \d+, column \d+|[\w.[\]]+): )?(.*)$/s.exec(message) ?? [];
  const where = place === undefined || place.startsWith("line") ? "" : place.replace(": ", "：");
  const found = KNOWN.find(([pattern]) => pattern.test(what));
  if (!found) return `场景有误。${where}${what}`;
  const words = what.replace(...(found as [RegExp, string]));
  return `${where}${TERMS.reduce((text, [term, its]) => text.replace(term, its), words)}`;
}
